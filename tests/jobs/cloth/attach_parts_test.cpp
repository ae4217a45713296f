// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/cloth/attach_parts.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "geometry/figure/attached_parts.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/self_intersections.h"
#include "geometry/mesh/sheet.h"
#include "geometry/mesh/struts.h"
#include "io/scene/scene.h"
#include "io/scene/state_file.h"
#include "jobs/base/part_names.h"
#include "jobs/chain/wrinkle.h"
#include "jobs/move/simulate.h"
#include "jobs/rest/drape.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"
#include "tests/test_meshes.h"

using namespace furrow;
using geometry::Vertex;
namespace fs = std::filesystem;

namespace {

Vertex vertex(std::size_t i) { return Vertex(Vertex::size_type(i)); }

void add(geometry::Mesh& mesh, const geometry::Mesh& more, const geometry::Vector& moved) {
  std::vector<Vertex> now;
  for (const Vertex v : more.vertices()) now.push_back(mesh.add_vertex(more.point(v) + moved));
  for (const geometry::Face f : more.faces()) {
    const geometry::Halfedge h = more.halfedge(f);
    mesh.add_face(now[more.source(h).idx()], now[more.target(h).idx()], now[more.target(more.next(h)).idx()]);
  }
}

constexpr double off = 0.003;  // of button and pocket from the sheet [m]

/// A sheet with a button and a pocket before it; the sheet's vertices come first.
struct Dressed {
  geometry::Mesh mesh = geometry::equilateral_sheet(0.3, 0.3, 0.02);
  std::size_t sheet = mesh.number_of_vertices(), button = 0;

  Dressed() {
    add(mesh, geometry::equilateral_sheet(0.015, 0.015, 0.0075), {0.15, 0.2, off});
    button = mesh.number_of_vertices();
    add(mesh, geometry::equilateral_sheet(0.08, 0.08, 0.02), {0.1, 0.05, off});
  }
};

/// The nearest that a point is to the sheet [m].
double from_sheet(const geometry::Point& p, const geometry::Mesh& mesh, const Dressed& dressed) {
  double nearest = 1;
  for (const geometry::Face f : mesh.faces()) {
    const geometry::Halfedge h = mesh.halfedge(f);
    if (mesh.source(h).idx() >= dressed.sheet) continue;
    const CGAL::Triangle_3<geometry::Point::R> t(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)),
                                                 mesh.point(mesh.target(mesh.next(h))));
    nearest = std::min(nearest, CGAL::squared_distance(p, t));
  }
  return std::sqrt(nearest);
}

/// How far the button's middle, or a vertex of the pocket, is from where it was before the sheet [m].
double strayed(const geometry::Mesh& mesh, const Dressed& dressed) {
  geometry::Vector middle = CGAL::NULL_VECTOR;
  for (std::size_t v = dressed.sheet; v < dressed.button; ++v)
    middle = middle + (mesh.point(vertex(v)) - CGAL::ORIGIN) / double(dressed.button - dressed.sheet);
  double most = std::abs(from_sheet(CGAL::ORIGIN + middle, mesh, dressed) - off);
  for (std::size_t v = dressed.button; v < mesh.number_of_vertices(); ++v)
    most = std::max(most, std::abs(from_sheet(mesh.point(vertex(v)), mesh, dressed) - off));
  return most;
}

jobs::SceneInput hung(const Dressed& dressed) {
  jobs::SceneInput scene;
  scene.memory.meshes["dressed"].mesh = dressed.mesh;
  scene.settings = io::parse_toml(
      "[garment]\nmesh = \"dressed\"\n[material]\npreset = \"cotton\"\n[forces]\nwind = [0, 0, 5]\n"
      "[simulation]\nseconds = 0.4\nintegrator = \"implicit\"\n[[pins]]\nbox = [-1, 0.28, -1, 1, 1, 0.001]\n",
      "test");
  return scene;
}

}  // namespace

TEST_CASE("attach_parts: button and pocket go with a sheet in the wind, also on from a state", "[release]") {
  const Dressed dressed;
  const fs::path folder = tests::empty_folder("attach_parts");
  tests::Recorder recorder;
  jobs::SimulateJob job;
  job.scene = hung(dressed);
  const jobs::SimulateReport whole = jobs::simulate(job, recorder);
  CHECK(recorder.warned_of("parts_attached"));
  const geometry::Mesh& end = whole.garment.mesh;
  CHECK(std::abs(end.point(vertex(0)).z()) > 0.02);  // the wind has it
  CHECK(strayed(end, dressed) < 0.001);
  io::set_value(job.scene.settings, "simulation.stop_at", 0.2, "test");
  io::set_value(job.scene.settings, "output.state", (folder / "state.ply").string(), "test");
  job.outputs_below = "";
  jobs::simulate(job, recorder);
  const jobs::SimulateReport on = jobs::simulate(jobs::resume_from(folder / "state.ply"), recorder);
  CHECK(strayed(on.garment.mesh, dressed) < 0.001);
  for (const Vertex v : end.vertices())
    CHECK(CGAL::squared_distance(end.point(v), on.garment.mesh->point(v)) < 1e-12);
}

TEST_CASE("attach_parts: what is pinned, and all of it where that is asked for, stays cloth", "[release]") {
  const Dressed dressed;
  tests::Recorder recorder;
  const jobs::Context context{{}, recorder};
  io::MeshFile file;
  file.mesh = dressed.mesh;
  jobs::attach_parts(file, {}, {}, "dressed", {{int(dressed.button)}}, context);
  const auto rides = geometry::rides_of(file.mesh);
  CHECK(std::count(rides.begin(), rides.end(), geometry::Ride::rigid) > 0);
  CHECK(std::count(rides.begin(), rides.end(), geometry::Ride::by_place) == 0);
  jobs::attach_parts(file, {}, {}, "dressed", {}, context);
  CHECK(geometry::rides_of(file.mesh) == rides);  // the file notes which do
  for (const auto& [key, value] : {std::pair("attach", false), {"attach", true}}) {
    jobs::SimulateJob job;
    job.scene = hung(dressed);
    io::set_value(job.scene.settings, std::string("garment.") + key, value, "test");
    io::set_value(job.scene.settings, "simulation.seconds", 0.01, "test");
    const auto end = geometry::rides_of(jobs::simulate(job, recorder).garment.mesh);
    CHECK(end.empty() == !value);
  }
}

TEST_CASE("attach_parts: names override what is found, are kept, and must be those of parts") {
  Dressed dressed;
  tests::Recorder recorder;
  const jobs::Context context{{}, recorder};
  io::MeshFile file;
  file.mesh = dressed.mesh;
  file.group_names = {"shirt", "pocket"};
  const geometry::Parts parts = geometry::find_parts(file.mesh);
  const auto group = geometry::ensure_map(file.mesh, geometry::attribute::group);
  for (const geometry::Face f : file.mesh->faces())
    group[f] = parts.of_face[f.idx()] == 0 ? 0 : parts.of_face[f.idx()] == 1 ? 1 : -1;
  CHECK(jobs::name_of_part(file, parts, 1) == "'pocket'");
  CHECK(jobs::name_of_part(file, parts, 2) == "part 2 (10 vertices)");  // the button's faces are before it
  const auto count = [&](geometry::Ride ride) {
    const auto rides = geometry::rides_of(file.mesh);
    return std::count(rides.begin(), rides.end(), ride);
  };
  jobs::attach_parts(file, {.free = {"pocket"}}, {}, "dressed", {}, context);
  CHECK(count(geometry::Ride::by_place) == 0);
  CHECK(count(geometry::Ride::rigid) > 0);
  CHECK(geometry::struts(file.mesh).empty());  // nor is its rim tied
  jobs::attach_parts(file, {}, {}, "dressed", {}, context);
  CHECK(count(geometry::Ride::by_place) == 0);  // as it was chosen
  CHECK(geometry::struts(file.mesh).empty());
  jobs::attach_parts(file, {.on = false, .parts = {"part 2"}}, {}, "dressed", {}, context);
  CHECK(count(geometry::Ride::by_place) == 0);
  CHECK(count(geometry::Ride::rigid) > 0);
  jobs::attach_parts(file, {.on = false}, {}, "dressed", {}, context);
  CHECK(geometry::rides_of(file.mesh).empty());
  const auto refuses = [&](const io::SceneAttach& attach, const std::vector<std::vector<int>>& pins,
                           const std::string& words) {
    CHECK_THROWS_WITH(jobs::attach_parts(file, attach, {}, "dressed", pins, context), Catch::Contains(words));
    CHECK(geometry::rides_of(file.mesh).empty());
  };
  refuses({.parts = {"belt"}}, {},
          "no part of the garment is called 'belt'; it has 'shirt', 'pocket', part 2");
  refuses({.parts = {"shirt"}}, {}, "largest");
  refuses({.parts = {"pocket"}, .free = {"pocket"}}, {}, "too");
  refuses({.on = false, .parts = {"pocket"}, .free = {"pocket"}}, {}, "too");
  refuses({.parts = {"part 2"}}, {{int(dressed.sheet)}}, "pinned");
}

TEST_CASE(
    "attach_parts: a ridge that is drawn under a pocket lifts it, and one on a pocket keeps it as cloth") {
  const Dressed dressed;
  tests::Recorder recorder;
  io::DrawnStroke ridge;
  ridge.stroke.height = 0.01;
  ridge.stroke.width = 0.08;
  ridge.stroke.points = {{-0.13, 0.03, 0}, {0.13, 0.03, 0}};
  jobs::WrinkleJob job;
  io::MeshFile file;
  file.mesh = dressed.mesh;
  job.garment = file;
  job.strokes = std::vector{ridge};
  job.options.detail = geometry::Detail::coarse;
  const geometry::Mesh drawn = jobs::wrinkle(job, recorder).garment.mesh;
  double lifted = 0;
  for (std::size_t v = dressed.button; v < dressed.mesh.number_of_vertices(); ++v)
    lifted = std::max(lifted, drawn.point(vertex(v)).z() - off);
  CHECK(lifted > 0.002);
  CHECK(geometry::count_self_intersections(drawn) == 0);
  ridge.stroke.points = {{0.08, 0.09, off}, {0.12, 0.09, off}};
  ridge.stroke.height = 0.003;
  ridge.stroke.width = 0.02;
  job.strokes = std::vector{ridge};
  const auto rides = geometry::rides_of(jobs::wrinkle(job, recorder).garment.mesh);
  CHECK(std::count(rides.begin(), rides.end(), geometry::Ride::by_place) == 0);
  CHECK(std::count(rides.begin(), rides.end(), geometry::Ride::rigid) > 0);
  const jobs::Context context{{}, recorder};
  jobs::attach_parts(file, {}, {}, "dressed", {}, context);  // before it is drawn on
  job.garment = file;
  const geometry::Mesh on_pocket = jobs::wrinkle(job, recorder).garment.mesh;
  CHECK(geometry::rides_of(on_pocket) == rides);
  double raised = 0;
  for (const geometry::Point& p : on_pocket.points()) raised = std::max(raised, p.z());
  CHECK(raised > off + 0.002);
}

TEST_CASE("attach_parts: a pocket that was drawn on is tied by its rim, in motion and at rest", "[release]") {
  const Dressed dressed;
  tests::Recorder recorder;
  io::DrawnStroke ridge;
  ridge.stroke.points = {{0.09, 0.09, off}, {0.11, 0.09, off}};
  ridge.stroke.height = 0.003;
  ridge.stroke.width = 0.02;
  jobs::WrinkleJob draw;
  io::MeshFile given;
  given.mesh = dressed.mesh;
  draw.garment = given;
  draw.strokes = std::vector{ridge};
  draw.options.detail = geometry::Detail::coarse;
  const io::MeshFile drawn = jobs::wrinkle(draw, recorder).garment;
  CHECK(recorder.warned_of("ends_tied"));
  const std::size_t ties = geometry::struts(drawn.mesh).size();
  REQUIRE(ties > 0);
  CHECK(ties % 3 == 0);
  const auto rim_strayed = [&](const geometry::Mesh& mesh) {
    double most = 0;
    for (std::size_t v = dressed.button; v < dressed.mesh.number_of_vertices(); ++v)
      if (mesh.is_border(vertex(v)))
        most = std::max(most, std::abs(from_sheet(mesh.point(vertex(v)), mesh, dressed) - off));
    return most;
  };
  jobs::SceneInput scene = hung(dressed);
  scene.memory.meshes["dressed"] = drawn;
  for (const bool ties_kept : {true, false}) {
    jobs::SimulateJob move;
    move.scene = scene;
    if (!ties_kept) geometry::set_struts(move.scene.memory.meshes["dressed"].mesh, {});
    io::set_value(move.scene.settings, "garment.attach", ties_kept, "test");
    CHECK((rim_strayed(jobs::simulate(move, recorder).garment.mesh) < 0.002) == ties_kept);
  }
  jobs::DrapeJob rest;
  rest.scene = scene;
  rest.scene.settings.root->erase("forces");
  rest.scene.settings.root->erase("simulation");
  const jobs::Draped once = jobs::drape(rest, recorder).garments.at(0);
  CHECK(once.outcome() == "at rest");
  CHECK(geometry::struts(once.file.mesh).size() == ties);
  CHECK(rim_strayed(once.file.mesh) < 0.002);
  CHECK(once.loose.empty());
  rest.subdivide = 1;
  const jobs::Draped finer = jobs::drape(rest, recorder).garments.at(0);
  CHECK(geometry::struts(finer.file.mesh).size() > ties);
  CHECK_FALSE(recorder.warned_of("struts_dropped"));
}

TEST_CASE("attach_parts: a drape takes no more iterations with button and pocket than without", "[release]") {
  const Dressed dressed;
  tests::Recorder recorder;
  jobs::DrapeJob job;
  job.scene = hung(dressed);
  job.scene.settings.root->erase("forces");
  job.scene.settings.root->erase("simulation");
  job.subdivide = 1;
  const jobs::Draped with = jobs::drape(job, recorder).garments.at(0);
  CHECK(with.outcome() == "at rest");
  CHECK(with.loose.empty());
  job.scene.memory.meshes["dressed"].mesh = geometry::equilateral_sheet(0.3, 0.3, 0.02);
  const jobs::Draped without = jobs::drape(job, recorder).garments.at(0);
  REQUIRE(with.report.levels.size() == without.report.levels.size());
  for (std::size_t i = 0; i < with.report.levels.size(); ++i)
    CHECK(with.report.levels[i].settle.iterations <= 1.3 * without.report.levels[i].settle.iterations + 2);
}
