// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/base/seam_ties.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/mesh/measures.h"
#include "geometry/mesh/struts.h"
#include "geometry/refine/subdivide.h"
#include "jobs/chain/wrinkle.h"
#include "jobs/cloth/pins.h"
#include "jobs/cloth/scene_cloth.h"
#include "jobs/mesh/doctor.h"
#include "jobs/mesh/subdivide.h"
#include "jobs/move/simulate.h"
#include "jobs/rest/drape.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"
#include "tests/test_meshes.h"

using namespace furrow;
namespace fs = std::filesystem;

namespace {

constexpr int across = 8, down = 6;  // cells of 5 cm

/// A level sheet of 0.4 x 0.3 m at the height 1, and a flap of 5 cm that stands on its middle row of edges:
/// three faces at each of them.
void write_flapped_sheet(const fs::path& path) {
  std::ofstream out(path);
  const auto at = [](int i, int j) { return 1 + i + (across + 1) * j; };
  for (int j = 0; j <= down; ++j)
    for (int i = 0; i <= across; ++i) out << "v " << 0.05 * i << " 1 " << 0.05 * j << "\n";
  for (int i = 0; i <= across; ++i) out << "v " << 0.05 * i << " 1.05 " << 0.15 << "\n";
  for (int j = 0; j < down; ++j)
    for (int i = 0; i < across; ++i)
      out << "f " << at(i, j) << " " << at(i, j + 1) << " " << at(i + 1, j) << "\nf " << at(i + 1, j) << " "
          << at(i, j + 1) << " " << at(i + 1, j + 1) << "\n";
  for (int i = 0; i < across; ++i)
    out << "f " << at(i, 3) << " " << at(i + 1, 3) << " " << at(i, 7) << "\nf " << at(i + 1, 3) << " "
        << at(i + 1, 7) << " " << at(i, 7) << "\n";
}

io::MeshFile flapped_sheet() {
  const fs::path folder = tests::empty_folder("seam_ties");
  write_flapped_sheet(folder / "flap.obj");
  return io::read_mesh(folder / "flap.obj");
}

double widest(const geometry::Mesh& mesh, const jobs::SeamTies& ties) {
  double widest = 0;
  for (const auto& [a, b] : ties)
    widest = std::max(widest, std::sqrt(CGAL::squared_distance(mesh.point(a), mesh.point(b))));
  return widest;
}

}  // namespace

TEST_CASE("seam_ties: what reading doubled is tied, on every level of refinement") {
  const io::MeshFile file = flapped_sheet();
  jobs::SeamTies ties = jobs::doubled_vertices(file);
  REQUIRE(ties.size() == 2 * (across + 1));  // both halves of the sheet, and the flap
  geometry::Mesh mesh = file.mesh;
  for (int level = 1; level <= 2; ++level) {
    ties = jobs::refined_ties(mesh, ties);
    geometry::loop_subdivide(mesh, 1);
    CHECK(ties.size() == 2 * (std::size_t(across << level) + 1));
    CHECK(widest(mesh, ties) < 0.02);  // the flap's border runs elsewhere than the sheet's inner edges
  }
  jobs::set_seam_ties(mesh, ties, {});
  CHECK(jobs::seam_ties(mesh).size() == ties.size());
  jobs::set_seam_ties(mesh, ties, {});
  CHECK(geometry::struts(mesh).size() == ties.size());
  jobs::close_seam_ties(mesh);
  CHECK(widest(mesh, ties) == 0);
  CHECK(jobs::doubled_vertices(io::MeshFile{}).empty());
}

TEST_CASE("open_seams: panels are one garment, with every vertex, unless the scene leaves them open") {
  const fs::path folder = tests::empty_folder("open_seams");
  std::ofstream(folder / "panels.obj") << "v 0 0 0\nv 0.1 0 0\nv 0.1 0.1 0\nv 0 0.1 0\nv 0.1 0 0\nv 0.2 0 0\n"
                                          "v 0.2 0.1 0\nv 0.1 0.1 0\nf 1 2 3 4\nf 5 6 7 8\n";
  io::Scene scene;
  scene.garment = folder / "panels.obj";
  scene.join = GENERATE(true, false);
  tests::Recorder recorder;
  const io::MeshFile file = jobs::begin_garment(scene, {jobs::Frame{}, recorder});
  CHECK(geometry::measure(file.mesh).components == (scene.join ? 1 : 2));
  CHECK(file.mesh->number_of_vertices() == 8);
  CHECK(recorder.warned_of("seams_joined") == scene.join);
  CHECK(recorder.warned_of("unjoined") == !scene.join);
  // In motion it goes with the other one.
  jobs::SimulateJob move;
  move.scene.settings = io::parse_toml(
      "[garment]\nmesh = \"panels.obj\"\n[[pins]]\nvertices = [0, 3]\n[simulation]\nseconds = 0.05\n",
      "test");
  move.scene.folder = folder;
  io::set_value(move.scene.settings, "garment.join", scene.join, "test");
  const geometry::Mesh moved = jobs::simulate(move, recorder).garment.mesh;
  CHECK((moved.point(geometry::Vertex(4)).y() < -0.01) == !scene.join);  // else its panel falls
  CHECK((moved.point(geometry::Vertex(4)) == moved.point(geometry::Vertex(1))) == scene.join);
  // Pins that name a vertex that is one with another hold that one.
  io::ScenePins pins;
  pins.vertices = {4, 1};
  const std::vector<std::vector<int>> held = jobs::find_pins(file, {pins});
  CHECK(held == std::vector<std::vector<int>>{scene.join ? std::vector{1} : std::vector{4, 1}});
}

TEST_CASE("seam_ties: a sheet that is held by its flap hangs on it, and is one piece when it is read again",
          "[long]") {
  const fs::path folder = tests::empty_folder("seam_ties_hung");
  write_flapped_sheet(folder / "flap.obj");
  for (const int levels : {0, 1}) {
    jobs::SimulateJob job;
    job.scene.settings = io::parse_toml(
        "[garment]\nmesh = \"flap.obj\"\n[[pins]]\nbox = [-1, 1.049, -1, 1, 2, 1]\n"
        "[simulation]\nseconds = 0.5\n[output]\nmesh = \"hung.ply\"\n",
        "test");
    job.scene.folder = folder;
    io::set_value(job.scene.settings, "garment.subdivide", levels, "test");
    tests::Recorder recorder;
    const jobs::SimulateReport report = jobs::simulate(job, recorder);
    CHECK(recorder.warned_of("seams_joined"));  // the sheet; the flap is tied to it
    CHECK(recorder.warned_of("seams_tied"));
    const geometry::MeshInfo info = geometry::measure(report.garment.mesh);
    CHECK(info.box_min.y() > 0.7);  // free fall is 1.2 m
    const jobs::SeamTies ties = jobs::seam_ties(report.garment.mesh);
    CHECK(ties.size() == std::size_t(across << levels) + 1);
    CHECK(widest(report.garment.mesh, ties) == 0);
    CHECK(jobs::seam_ties(io::read_mesh(folder / "hung.ply").mesh).size() == ties.size());
  }
}

TEST_CASE("doctor: a seam of three faces is tied in the mended PLY, and other formats are told of") {
  const fs::path folder = tests::empty_folder("doctor_seam");
  write_flapped_sheet(folder / "flap.obj");
  jobs::DoctorJob job;
  job.mesh = folder / "flap.obj";
  job.repair = true;
  job.output = folder / "mended.ply";
  tests::Recorder recorder;
  const jobs::DoctorReport mended = jobs::doctor(job, recorder);
  CHECK_FALSE(mended.found.empty());
  CHECK(mended.well());
  job.repair = false;
  job.mesh = job.output;
  job.output = "";
  const jobs::DoctorReport again = jobs::doctor(job, recorder);
  for (const jobs::Ailment& a : again.found) CHECK(a.code + ": " + a.text == "");
  CHECK(jobs::seam_ties(again.mesh.mesh).size() == 2 * (across + 1));
  CHECK_FALSE(recorder.warned_of("ties_lost"));
  job.mesh = folder / "flap.obj";
  job.repair = true;
  job.output = folder / "mended.obj";
  jobs::doctor(job, recorder);
  CHECK(recorder.warned_of("ties_lost"));
}

TEST_CASE("seam_ties: subdivide and wrinkle write a PLY whose seams are tied, on every new level") {
  const fs::path folder = tests::empty_folder("seam_ties_kept");
  write_flapped_sheet(folder / "flap.obj");
  for (const jobs::Refinement refinement : {jobs::Refinement::loop, jobs::Refinement::linear}) {
    jobs::SubdivideJob job{folder / "flap.obj"};
    job.refinement = refinement;
    job.steps = 2;
    job.output = folder / "fine.ply";
    tests::Recorder recorder;
    jobs::subdivide(job, recorder);
    CHECK(recorder.warned_of("seams_tied"));
    CHECK_FALSE(recorder.warned_of("ties_lost"));
    const geometry::Mesh fine = io::read_mesh(folder / "fine.ply").mesh;
    const jobs::SeamTies ties = jobs::seam_ties(fine);
    CHECK(ties.size() == 2 * (4 * across + 1));
    CHECK(widest(fine, ties) == 0);
    job.output = folder / "fine.obj";
    jobs::subdivide(job, recorder);
    CHECK(recorder.warned_of("ties_lost"));
  }
  jobs::WrinkleJob job;
  job.garment = folder / "flap.obj";
  geometry::Stroke stroke;  // across the seam
  stroke.height = 0.01;
  stroke.points = {{0.11, 1, 0.05}, {0.13, 1, 0.25}};
  job.strokes = std::vector<io::DrawnStroke>{{stroke}};
  job.options.insertion.rule = geometry::InsertionRule::safe;
  job.output = folder / "wrinkled.ply";
  tests::Recorder recorder;
  jobs::wrinkle(job, recorder);
  CHECK(jobs::seam_ties(io::read_mesh(job.output).mesh).size() == across + 1);
  job.garment = folder / "fine.ply";
  jobs::wrinkle(job, recorder);
  CHECK(jobs::seam_ties(io::read_mesh(job.output).mesh).size() == 2 * (4 * across + 1));
}
