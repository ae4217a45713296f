// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/rest/drape.h"

#include <CGAL/Polygon_mesh_processing/orientation.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "geometry/fold/wrinkle.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/sheet.h"
#include "geometry/refine/subdivide.h"
#include "geometry/rest/rest_metric.h"
#include "io/scene/scene.h"
#include "jobs/body/world_body.h"
#include "jobs/move/simulate.h"
#include "jobs/rest/drape_garment.h"
#include "jobs/rest/drape_starts.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"
#include "tests/jobs/rest/across_ball.h"
#include "tests/test_meshes.h"
#include "tests/test_paths.h"

using namespace furrow;
using tests::across_ball;
using tests::set;
namespace fs = std::filesystem;

namespace {

/// The same with its meshes in files.
jobs::DrapeJob of_files(jobs::DrapeJob job, const fs::path& folder) {
  for (const char* name : {"sheet", "ball"})
    io::write_mesh(folder / (name + std::string(".ply")), job.scene.memory.meshes.at(name));
  job.scene.memory = {};
  set(job, "garment.mesh", (folder / "sheet.ply").string());
  set(job, "body.mesh", (folder / "ball.ply").string());
  return job;
}

/// Numbers of a report that no clock made.
io::Json without_clock(const jobs::DrapeJobReport& report) {
  io::Json json = to_json(report);
  json.erase("seconds");
  return json;
}

bool remarks_on(const jobs::DrapeJobReport& report, const std::string& code) {
  return std::any_of(report.remarks.begin(), report.remarks.end(),
                     [&](const jobs::DrapeRemark& r) { return r.remark.code == code; });
}

}  // namespace

TEST_CASE("drape: a garment is refined no more once its edges keep the gap to a tenth") {
  const geometry::Mesh tube = tests::cylinder(0.1, 0.4, 12, 8);
  geometry::Mesh measured = tube;
  geometry::ensure_rest_lengths(measured);
  const double tolerance = 1e-4, kept = jobs::edge_sag(measured) / 4 + tolerance;
  CHECK(jobs::refinements_for_gap(tube, kept / 1.09, tolerance) == 1);
  CHECK(jobs::refinements_for_gap(tube, kept / 1.11, tolerance) == 2);
}

TEST_CASE("drape: a garment and a body in memory come to the bits of their files", "[release]") {
  const fs::path folder = tests::empty_folder("drape_memory");
  tests::Recorder recorder;
  const jobs::DrapeJob in_memory = across_ball();
  jobs::DrapeJob filed = of_files(in_memory, folder);
  filed.output = folder / "worn.ply";
  const jobs::DrapeJobReport a = jobs::drape(in_memory, recorder), b = jobs::drape(filed, recorder);
  INFO(to_json(a).dump(1));
  CHECK(a.garments.at(0).rests());
  CHECK(a.garments[0].outcome().rfind("at rest", 0) == 0);
  CHECK(a.garments[0].report.levels.back().settle.touching > 3);
  CHECK(tests::positions(a.garments[0].file) == tests::positions(b.garments[0].file));
  CHECK(without_clock(a) == without_clock(b));
  CHECK(tests::positions(io::read_mesh(filed.output)) == tests::positions(b.garments[0].file));
  CHECK_FALSE(a.fails());
}

TEST_CASE("drape: fabrics are draped one after the other, each to the bits of its own job", "[release]") {
  tests::Recorder recorder;
  jobs::DrapeJob job = across_ball();
  job.scene.settings.root->at("material").erase("preset");
  job.fabrics = {"silk", "denim"};
  const jobs::DrapeJobReport report = jobs::drape(job, recorder);
  REQUIRE(report.garments.size() == 2);
  for (const jobs::Draped& d : report.garments)
    CHECK(tests::positions(jobs::drape(across_ball(d.name), recorder).garments[0].file) ==
          tests::positions(d.file));
  CHECK(to_json(report).at("garments").size() == 2);
}

TEST_CASE("drape: warnings and remarks have their codes", "[long]") {
  tests::Recorder recorder;
  jobs::DrapeJob job = across_ball();
  set(job, "material.gap", 0.0005);
  set(job, "simulation.seconds", 3);
  set(job, "pins.0", io::Json{{"box", {-1, -1, -1, 1, 1, 1}}});
  for (geometry::Point& p : job.scene.memory.meshes["sheet"].mesh->points()) p = {p.x(), 0.05, p.z()};
  jobs::drape(job, recorder);
  CHECK(recorder.warned_of("gap_raised"));
  CHECK(recorder.warned_of("pins_inside_body"));
  CHECK(recorder.warned_of("settings_unused"));
  job = across_ball();
  job.settings.iterations = 1;
  const jobs::DrapeJobReport hurried = jobs::drape(job, recorder);
  CHECK(remarks_on(hurried, "not_at_rest"));
  CHECK(hurried.fails());
  for (geometry::Point& p : job.scene.memory.meshes["sheet"].mesh->points()) p = {p.x() + 2, p.y(), p.z()};
  const jobs::DrapeJobReport beside = jobs::drape(job, recorder);
  CHECK(remarks_on(beside, "touches_nothing"));
  CHECK(remarks_on(beside, "falls"));
  CHECK(beside.fails());
}

TEST_CASE("drape: of several starts the rest with the lowest energy is taken, and numbers have a spread",
          "[release]") {
  const fs::path folder = tests::empty_folder("drape_starts");
  jobs::DrapeJob job = across_ball();
  tests::Recorder recorder;
  const jobs::Draped single = jobs::drape(job, recorder).garments.at(0);
  CHECK_FALSE(single.starts);
  CHECK(single.report.energy.weight < 0);
  set(job, "simulation.starts", 3);
  job.output = folder / "worn.ply";
  const jobs::DrapeJobReport report = jobs::drape(job, recorder);
  const jobs::Draped& d = report.garments.at(0);
  REQUIRE(d.starts);
  const std::vector<jobs::DrapeStart>& runs = d.starts->runs;
  REQUIRE(runs.size() == 3);
  CHECK(d.starts->resting() == 3);
  CHECK(runs[0].energy.total() == single.report.energy.total());  // the first is that of one start
  CHECK(runs[1].energy.total() != runs[0].energy.total());
  for (const jobs::DrapeStart& run : runs) CHECK(run.energy.total() >= d.report.energy.total() * (1 + 1e-6));
  CHECK(runs[d.starts->chosen].energy.total() == d.report.energy.total());
  CHECK(tests::positions(io::read_mesh(job.output)) == tests::positions(d.file));
  const auto hem = std::find_if(d.starts->spread.begin(), d.starts->spread.end(),
                                [](const jobs::NumberSpread& s) { return s.name == "hem_height"; });
  REQUIRE(hem != d.starts->spread.end());
  CHECK(hem->count == 3);
  CHECK(hem->least <= hem->mean);
  CHECK(hem->mean <= hem->most);
  CHECK(hem->deviation > 0);
  CHECK(hem->deviation <= hem->most - hem->least);
  const io::Json json = to_json(report);
  CHECK(json.at("starts").at("runs").size() == 3);
  CHECK(json.at("energy").at("total").get<double>() == d.report.energy.total());
  job.settings.animation = folder / "way.pc2";
  CHECK_THROWS_WITH(jobs::drape(job, recorder), Catch::Contains("`starts`"));
}

TEST_CASE("drape: a spread that is wider than what its number decides is told, and outcomes that differ") {
  jobs::Draped d;
  d.name = "shirt";
  jobs::DrapeStarts starts;
  const auto add = [&](double ease, double hem, const std::string& outcome) {
    jobs::DrapeStart start;
    start.rests = true;
    start.outcome = outcome;
    start.numbers = {{"ease_waist", ease}, {"hem_height", hem}};
    starts.runs.push_back(start);
  };
  const auto codes = [&] {
    starts.spread = jobs::spread_of(starts.runs);
    d.starts = starts;
    std::set<std::string> found;
    for (const jobs::Warning& w : jobs::doubts_of(d))
      found.insert(w.code + (w.text.find("ease") < 30 ? " ease" : ""));
    return found;
  };
  add(0.050, 0.700, "at rest"), add(0.052, 0.704, "at rest");
  CHECK(codes().empty());
  CHECK(starts.spread.at(1).name == "ease_waist");
  CHECK(starts.spread[1].mean == Approx(0.051));
  CHECK(starts.spread[1].deviation == Approx(0.002 / std::sqrt(2.0)));
  add(0.075, 0.702, "at rest");
  CHECK(codes() == std::set<std::string>{"spread_wide ease"});
  add(0.051, 0.702, "at rest, pierced by the body");
  CHECK(codes() == std::set<std::string>{"spread_wide ease", "starts_disagree"});
  starts.runs.erase(starts.runs.begin() + 2, starts.runs.end());
  add(0.051, 0.740, "at rest");
  CHECK(codes() == std::set<std::string>{"spread_wide"});
  starts.runs.back().rests = false;  // what does not rest is no number
  CHECK(codes().empty());
}

TEST_CASE("drape: a job that cannot be is refused before anything is written", "[long]") {
  const fs::path folder = tests::empty_folder("drape_refused");
  tests::Recorder recorder;
  const jobs::DrapeJob good = of_files(across_ball(), folder);
  const std::string sheet = tests::bytes_of(folder / "sheet.ply");
  const auto refused = [&](const auto& spoil) {
    jobs::DrapeJob job = good;
    job.output = folder / "worn.ply";
    job.settings.animation = folder / "way.pc2";
    spoil(job);
    CHECK_THROWS_AS(jobs::drape(job, recorder), std::invalid_argument);
  };
  refused([](auto& job) { job.scene.settings.root->erase("body"); });
  refused([](auto& job) { job.settings.residual = 0; });
  refused([](auto& job) { job.settings.penetration = -1; });
  refused([](auto& job) { job.settings.bending_friction = -1; });
  refused([](auto& job) { job.settings.iterations = -1; });
  refused([](auto& job) { job.settings.contact_depth = 0; });
  refused([](auto& job) { job.settings.plain = true, job.settings.contact_depth = 1e-5; });
  refused([](auto& job) { job.settings.bands = {{"no-such-loop", 0.9}}; });
  refused([](auto& job) { job.settings.bands = {{"top", 0}}; });
  refused([](auto& job) { job.settings.bands = {{"top", 0.9}}, job.settings.band_stiffness = -1; });
  refused([](auto& job) { job.subdivide = -1; });
  refused([](auto& job) { job.subdivide = 7; });
  refused([](auto& job) { job.fabrics = {"cotton", "silk"}; });
  refused([](auto& job) { set(job, "lines.0", io::Json{{"strokes", "sheet.ply"}}); });
  refused([&](auto& job) { job.settings.animation = folder / "way.avi"; });
  refused([&](auto& job) { job.settings.animation = job.output = folder / "way.obj"; });
  refused([&](auto& job) { job.output = folder / "sheet.ply"; });
  refused([&](auto& job) { job.more_inputs = {job.output.string()}; });
  jobs::DrapeJob job = good;
  job.output = folder / "nowhere" / "worn.ply";
  CHECK_THROWS_AS(jobs::drape(job, recorder), std::runtime_error);
  job.output = folder / "worn.ply";
  set(job, "garment.mesh", (folder / "none.ply").string());
  CHECK_THROWS_AS(jobs::drape(job, recorder), std::runtime_error);
  CHECK(tests::names_in(folder) == std::set<std::string>{"ball.ply", "sheet.ply"});
  CHECK(tests::bytes_of(folder / "sheet.ply") == sheet);
}

TEST_CASE("drape: two jobs at once in one process give the bits of single runs", "[release]") {
  tests::Recorder recorder;
  const jobs::DrapeJob one = across_ball("silk"), two = across_ball("denim");
  const jobs::DrapeJobReport single_one = jobs::drape(one, recorder), single_two = jobs::drape(two, recorder);
  jobs::DrapeJobReport both_one, both_two;
  std::thread other([&] {
    tests::Recorder own;
    both_two = jobs::drape(two, own);
  });
  both_one = jobs::drape(one, recorder);
  other.join();
  CHECK(tests::positions(both_one.garments[0].file) == tests::positions(single_one.garments[0].file));
  CHECK(tests::positions(both_two.garments[0].file) == tests::positions(single_two.garments[0].file));
  CHECK(tests::positions(both_one.garments[0].file) != tests::positions(both_two.garments[0].file));
}

namespace {

/// Adds a copy of a mesh to another.
void add(geometry::Mesh& to, const geometry::Mesh& from, const geometry::Vector& by) {
  std::vector<geometry::Vertex> copies;
  for (const geometry::Vertex v : from.vertices()) copies.push_back(to.add_vertex(from.point(v) + by));
  for (const geometry::Face f : from.faces()) {
    std::vector<geometry::Vertex> corners;
    for (const geometry::Vertex v : from.vertices_around_face(from.halfedge(f)))
      corners.push_back(copies[v.idx()]);
    to.add_face(corners);
  }
}

/// Two squares across the ball, one 1 mm over the other.
jobs::DrapeJob two_layers() {
  jobs::DrapeJob job = across_ball();
  geometry::Mesh& sheet = job.scene.memory.meshes["sheet"].mesh;
  const geometry::Mesh other = sheet;
  add(sheet, other, {0.004, 0.001, 0.003});
  job.subdivide = 1;
  return job;
}

const jobs::Draped& only(const jobs::DrapeJobReport& report) { return report.garments.at(0); }

}  // namespace

TEST_CASE("drape: cloth that comes to cross other cloth is counted, placed and no success", "[long]") {
  tests::Recorder recorder;
  jobs::DrapeJob job = two_layers();
  job.settings.self_contact = jobs::SelfContactUse::off;
  const jobs::DrapeJobReport report = jobs::drape(job, recorder);
  const jobs::ClothCrossings& c = only(report).crossings;
  INFO(to_json(report).dump(1));
  REQUIRE(c.at_start == 0u);
  REQUIRE(c.pairs > 0);
  CHECK(c.from_start == 0);
  CHECK(c.places.at(0).parts[0] != c.places[0].parts[1]);
  CHECK(report.fails());
  CHECK(remarks_on(report, "cloth_crosses"));
  CHECK(only(report).outcome().find("cloth crosses itself") != std::string::npos);
  CHECK(to_json(report).at("crossings").at("new") == c.pairs);
  CHECK(to_json(report).at("crossings").at("corners") == c.corners);
  for (const geometry::Face f : c.faces)
    for (const geometry::Vertex v :
         only(report).file.mesh->vertices_around_face(only(report).file.mesh->halfedge(f)))
      CHECK(std::binary_search(c.corners.begin(), c.corners.end(), std::size_t(v)));
  set(job, "garment.allow_crossings", c.pairs);
  CHECK_FALSE(only(jobs::drape(job, recorder)).crosses_itself());
}

TEST_CASE("drape: cloth keeps off cloth by default, and one search is enough where that comes to rest",
          "[long]") {
  tests::Recorder recorder;
  jobs::DrapeJob job = two_layers();
  const auto with = [&](jobs::SelfContactUse use) {
    job.settings.self_contact = use;
    return jobs::drape(job, recorder);
  };
  const jobs::DrapeJobReport on = with(jobs::SelfContactUse::on),
                             automatic = with(jobs::SelfContactUse::automatic);
  INFO(to_json(on).dump(1) << to_json(automatic).dump(1));
  CHECK(only(automatic).crossings.pairs == 0);
  CHECK(only(automatic).self_contact);
  CHECK_FALSE(automatic.fails());
  CHECK(tests::positions(only(automatic).file) == tests::positions(only(on).file));
  CHECK_FALSE(only(automatic).other);
  CHECK_FALSE(to_json(automatic).contains("other_search"));
}

TEST_CASE("drape: where nothing touches, contact by default has the numbers of none, at rest or not",
          "[long]") {
  tests::Recorder recorder;
  jobs::DrapeJob job = across_ball();
  for (const std::optional<int> iterations : {std::optional<int>{}, std::optional<int>{3}}) {
    job.settings.iterations = iterations;
    job.settings.self_contact = jobs::SelfContactUse::off;
    const jobs::DrapeJobReport off = jobs::drape(job, recorder);
    job.settings.self_contact = jobs::SelfContactUse::automatic;
    const jobs::DrapeJobReport automatic = jobs::drape(job, recorder);
    CHECK(only(automatic).rests() == !iterations);
    CHECK(tests::positions(only(automatic).file) == tests::positions(only(off).file));
    CHECK(only(automatic).outcome() == only(off).outcome());
    CHECK_FALSE(only(automatic).other);  // the same search again would find nothing else
    CHECK_FALSE(only(automatic).report.levels.back().acted());
  }
}

TEST_CASE("drape: where contact finds no rest and cloth crosses nothing without, that is taken and told",
          "[long]") {
  tests::Recorder recorder;
  jobs::DrapeJob job = two_layers();
  job.settings.thickness = 0.02;  // of layers 1 mm apart
  set(job, "garment.allow_crossings", 100000);
  job.settings.iterations = 22;  // without contact fewer are enough
  const jobs::DrapeJobReport automatic = jobs::drape(job, recorder);
  job.settings.self_contact = jobs::SelfContactUse::off;
  const jobs::DrapeJobReport off = jobs::drape(job, recorder);
  INFO(to_json(automatic).dump(1));
  CHECK_FALSE(automatic.fails());
  CHECK_FALSE(only(automatic).self_contact);
  CHECK(tests::positions(only(automatic).file) == tests::positions(only(off).file));
  REQUIRE(only(automatic).other);
  CHECK(only(automatic).other->self_contact);
  CHECK(only(automatic).other->outcome.find("not at rest") == 0);
  CHECK(remarks_on(automatic, "contact_left_out"));
  const io::Json told = to_json(automatic);
  CHECK(told.at("other_search").at("outcome") == only(automatic).other->outcome);
  CHECK_FALSE(told.contains("self_contact"));
}

TEST_CASE("drape: where contact finds no rest, that is taken all the same if cloth crosses itself without",
          "[long]") {
  tests::Recorder recorder;
  jobs::DrapeJob job = two_layers();
  job.settings.thickness = 0.02;  // of layers 1 mm apart
  job.settings.iterations = 22;   // without contact fewer are enough
  const jobs::DrapeJobReport report = jobs::drape(job, recorder);
  INFO(to_json(report).dump(1));
  REQUIRE(only(report).other);
  CHECK_FALSE(only(report).other->self_contact);
  CHECK(only(report).other->crossings > 0);
  CHECK(only(report).self_contact);
  CHECK(only(report).crossings.pairs == 0);
  CHECK_FALSE(only(report).rests());
  CHECK(report.fails());
  CHECK(remarks_on(report, "contact_kept"));
}

TEST_CASE("drape: the gap is kept from an inner side, and not raised by what lies outside") {
  tests::Recorder recorder;
  const auto gap_with = [&](double off) {
    jobs::DrapeJob job = across_ball();
    job.settings.iterations = 0;
    geometry::Mesh& sheet = job.scene.memory.meshes["sheet"].mesh;
    geometry::Mesh other = sheet;
    CGAL::Polygon_mesh_processing::reverse_face_orientations(other);
    if (off != 0) add(sheet, other, {0, off, 0});
    return only(jobs::drape(job, recorder)).gap;
  };
  const double gap = gap_with(0);
  CHECK(gap_with(-0.0015) == Approx(gap + 0.0015).margin(5e-5));
  CHECK(gap_with(0.0015) == Approx(gap).margin(1e-5));
}

TEST_CASE("drape: crossings that were drawn are told from new ones, on a refined garment, too") {
  tests::Recorder recorder;
  jobs::DrapeJob job = across_ball();
  geometry::Mesh& sheet = job.scene.memory.meshes["sheet"].mesh;
  geometry::Mesh spike;
  spike.add_face(spike.add_vertex({0.012, 0.09, 0.011}), spike.add_vertex({0.02, 0.12, 0.012}),
                 spike.add_vertex({0.013, 0.12, 0.02}));
  add(sheet, spike, {0, 0, 0});
  tests::set(job, "garment.attach", false);
  job.subdivide = 1;
  job.settings.iterations = 0;
  const jobs::ClothCrossings c = only(jobs::drape(job, recorder)).crossings;
  CHECK(c.at_start.value() > 0);
  CHECK(c.pairs == c.from_start);
}

TEST_CASE("drape: a garment far too small for its body is torn, whatever balances", "[release]") {
  tests::Recorder recorder;
  jobs::DrapeJob job = across_ball();
  geometry::Mesh tube = tests::cylinder(0.025, 0.5, 24, 40);  // through the ball's centre, out on both sides
  for (geometry::Point& p : tube.points()) p = {p.x(), p.y() - 0.25, p.z()};
  job.scene.memory.meshes["sheet"].mesh = tube;
  job.subdivide = 0;
  const jobs::DrapeJobReport report = jobs::drape(job, recorder);
  INFO(to_json(report).dump(1));
  CHECK(only(report).end.is_torn());
  CHECK(report.fails());
  CHECK(remarks_on(report, "torn"));
  CHECK(only(report).outcome().rfind("torn", 0) == 0);
}

TEST_CASE("drape: numbers beyond any cloth's are a numerical failure, and do not fall", "[long]") {
  tests::Recorder recorder;
  for (const auto& [path, value] :
       {std::pair<const char*, io::Json>{"forces.gravity", 1e300}, {"material.stretch", 1e30}}) {
    jobs::DrapeJob job = across_ball();
    for (geometry::Point& p : job.scene.memory.meshes["sheet"].mesh->points())
      p = {p.x(), p.y() + 0.1, p.z()};
    job.subdivide = 0;
    set(job, path, value);
    const jobs::DrapeJobReport report = jobs::drape(job, recorder);
    INFO(path << to_json(report).dump(1));
    CHECK(only(report).outcome().rfind("numerical failure", 0) == 0);
    CHECK(remarks_on(report, "numerical_failure"));
    CHECK_FALSE(remarks_on(report, "falls"));
    CHECK(report.fails());
  }
}

TEST_CASE("drape: a part that nothing holds is named and goes with the cloth, and the rest comes to rest",
          "[long]") {
  tests::Recorder recorder;
  jobs::DrapeJob job = across_ball();
  job.subdivide = 0;
  const jobs::DrapeJobReport alone = jobs::drape(job, recorder);
  REQUIRE(only(alone).rests());
  geometry::Mesh& sheet = job.scene.memory.meshes["sheet"].mesh;
  const std::size_t count = sheet.number_of_vertices();
  geometry::Mesh button;
  button.add_face(button.add_vertex({0, 0, 0}), button.add_vertex({0.02, 0, 0}),
                  button.add_vertex({0, 0.02, 0}));
  add(sheet, button, {1, 0, 0});
  const geometry::Point lay = sheet.point(geometry::Vertex{geometry::Vertex::size_type(count)});
  const jobs::DrapeJobReport report = jobs::drape(job, recorder);
  const jobs::Draped& d = only(report);
  INFO(to_json(report).dump(1));
  CHECK(d.rests());
  CHECK(d.end.parts.size() == 2);
  REQUIRE(d.loose.size() == 1);
  CHECK(d.loose[0].find("3 vertices") != std::string::npos);
  CHECK(d.outcome().find("1 of 2 parts loose") != std::string::npos);
  CHECK(remarks_on(report, "loose_parts"));
  CHECK_FALSE(remarks_on(report, "not_at_rest"));
  CHECK_FALSE(report.fails());  // it is small
  CHECK(to_json(report).at("loose").at("done") == "held");
  const geometry::Vertex first{geometry::Vertex::size_type(count)};
  CHECK(CGAL::squared_distance(d.file.mesh->point(first), lay) > 1e-4);  // the sheet's corner hangs down
  set(job, "pins.0", io::Json{{"box", {0.9, -1, -1, 2, 1, 1}}});         // the advice
  CHECK_FALSE(jobs::drape(job, recorder).fails());
}

TEST_CASE("drape: parts that fall one after the other are not refined, however coarse they are", "[long]") {
  tests::Recorder recorder;
  jobs::DrapeJob job = across_ball();
  geometry::Mesh& sheet = job.scene.memory.meshes["sheet"].mesh;
  const geometry::Mesh copy = sheet;
  for (geometry::Point& p : sheet.points()) p = {p.x() + 2, p.y(), p.z()};
  geometry::Mesh button;
  button.add_face(button.add_vertex({0, 0, 0}), button.add_vertex({0.02, 0, 0}),
                  button.add_vertex({0, 0.02, 0}));
  add(sheet, button, {1, 0, 0});
  add(sheet, copy, {4, 0.5, 0});
  job.subdivide = 2;
  const std::size_t count = sheet.number_of_vertices();
  const jobs::DrapeJobReport report = jobs::drape(job, recorder);
  INFO(to_json(report).dump(1));
  CHECK(only(report).end.falls());
  CHECK(remarks_on(report, "falls"));
  CHECK(only(report).report.levels.size() == 1);
  CHECK(only(report).file.mesh->number_of_vertices() == count);
}

TEST_CASE("drape: a gap that edges raise is refined away, and said where it is not", "[release]") {
  tests::Recorder recorder;
  jobs::DrapeJob job = across_ball();
  set(job, "body.tolerance", 0.0005);
  const jobs::Draped refined = only(jobs::drape(job, recorder));
  CHECK(refined.refinements > 0);
  CHECK(refined.gap < 1.05 * refined.wanted_gap);
  CHECK_FALSE(refined.floats());
  job.subdivide = 0;
  const jobs::Draped coarse = only(jobs::drape(job, recorder));
  CHECK(coarse.refinements == 0);
  CHECK(coarse.floats());
  CHECK(coarse.outcome().find("off the body") != std::string::npos);
  job.subdivide = refined.refinements;
  CHECK(tests::positions(only(jobs::drape(job, recorder)).file) == tests::positions(refined.file));
}

namespace {

/// A square of cloth that stands upright in the air, held by its upper edge; in memory.
jobs::DrapeJob from_its_edge() {
  jobs::DrapeJob job;
  geometry::Mesh& sheet = job.scene.memory.meshes["sheet"].mesh;
  sheet = geometry::equilateral_sheet(0.3, 0.3, 0.02);
  double top = 0;
  for (const geometry::Vertex v : sheet.vertices()) top = std::max(top, sheet.point(v).y());
  job.scene.settings = io::parse_toml("[garment]\nmesh = \"sheet\"\n", "test");
  set(job, "material", {{"membrane", "triangles"}, {"bending_law", "hinge"}, {"density", 0.2}});
  set(job, "material.stretch", 100);
  set(job, "material.poisson", 0);
  set(job, "pins.0", io::Json{{"box", {-1, top - 0.001, -1, 1, top + 0.001, 1}}});
  return job;
}

}  // namespace

TEST_CASE("drape: a small fold does not strain a garment that friction alone holds", "[release]") {
  const fs::path pair = tests::shared_dir() / "meshes/pairs/mh_female";
  if (!tests::have_shared()) {
    WARN("skipped: no shared data");
    return;
  }
  io::MeshFile skirt = io::read_mesh(pair / "skirt.obj");
  geometry::loop_subdivide(skirt.mesh, 1);
  geometry::Stroke stroke;
  stroke.height = 0.002;
  stroke.width = 0.03;
  stroke.points = {{0, 0.3, 0.13}, {0, 0.2, 0.14}};
  geometry::WrinkleOptions options;
  geometry::wrinkle(skirt.mesh, std::vector<geometry::Stroke>{stroke}, options);
  io::WrinkleRecord record;
  record.options = "--rule fold";
  io::set_wrinkle_record(skirt, record);
  jobs::DrapeJob job;
  job.scene.memory.meshes["skirt"] = skirt;
  job.scene.settings = io::parse_toml("[garment]\nmesh = \"skirt\"\n", "test");
  set(job, "body.mesh", (pair / "body.obj").string());
  set(job, "material.preset", "cotton");
  tests::Recorder recorder;
  const jobs::Draped draped = only(jobs::drape(job, recorder));
  CHECK(draped.succeeds());
  REQUIRE(draped.fit.strain);
  CHECK(draped.fit.strain->max < 0.04);  // 0.077 by a soft start
}

TEST_CASE("drape: without a body a sheet hangs from its edge and stretches by its own weight") {
  tests::Recorder recorder;
  const jobs::DrapeJob job = from_its_edge();
  const geometry::Mesh& before = job.scene.memory.meshes.at("sheet").mesh;
  const jobs::DrapeJobReport report = jobs::drape(job, recorder);
  const jobs::Draped d = only(report);
  INFO(to_json(report).dump(1));
  CHECK(d.outcome() == "at rest");
  CHECK_FALSE(report.fails());
  CHECK(d.refinements == 0);
  CHECK_FALSE(d.fit.on_body);
  double low = 1, low_before = 1, high = -1;
  for (const geometry::Point& p : d.file.mesh->points()) low = std::min(low, p.y());
  for (const geometry::Point& p : before.points())
    low_before = std::min(low_before, p.y()), high = std::max(high, p.y());
  const double height = high - low_before;
  CHECK(low_before - low == Approx(0.2 * 9.81 * height * height / (2 * 100)).epsilon(0.03));
  CHECK(d.fit.strain->max == Approx(0.2 * 9.81 * height / 100).epsilon(0.1));
  const io::Json json = to_json(report);
  CHECK(json["gap"].is_null());
  CHECK(json["fit"]["distance"].is_null());
  CHECK(json["fit"]["body_height"].is_null());
  CHECK(json["angle_defect"].get<double>() < 0.1);
  CHECK_FALSE(remarks_on(report, "touches_nothing"));
}

TEST_CASE("drape: on patches a sheet hangs as on triangles, which a motion of it takes and says so") {
  tests::Recorder recorder;
  jobs::DrapeJob job = from_its_edge();
  const jobs::Draped plain = only(jobs::drape(job, recorder));
  set(job, "material.membrane", "patches");
  const jobs::Draped patched = only(jobs::drape(job, recorder));
  CHECK(patched.outcome() == "at rest");
  const auto low = [](const jobs::Draped& d) {
    double y = 1;
    for (const geometry::Point& p : d.file.mesh->points()) y = std::min(y, p.y());
    return y;
  };
  CHECK(low(patched) == Approx(low(plain)).margin(5e-4));
  CHECK(low(patched) != low(plain));
  CHECK_FALSE(recorder.warned_of("patches_are_triangles"));
  job.scene.memory.meshes["sheet"] = patched.file;
  set(job, "simulation.seconds", 0.01);
  jobs::SimulateJob motion;
  motion.scene = job.scene;
  jobs::simulate(motion, recorder);
  CHECK(recorder.warned_of("patches_are_triangles"));
}

TEST_CASE("drape: what holds a garment carries its weight: a pin, a body, or both, and a band pulls",
          "[long]") {
  jobs::DrapeJob hung = across_ball();
  hung.scene.settings.root->erase("body");
  set(hung, "pins.0.vertices", io::Json::array({0, 1, 2, 3, 4, 5, 6}));
  set(hung, "garment.subdivide", 0);
  tests::Recorder recorder;
  const jobs::DrapeForces by_pin = jobs::drape(hung, recorder).garments.at(0).forces;
  REQUIRE(by_pin.pins.size() == 1);
  CHECK(by_pin.pins[0].name == "vertices");
  CHECK(by_pin.pins[0].force.y() == Approx(-by_pin.weight.y()).epsilon(1e-3));
  jobs::DrapeJob worn = across_ball();
  worn.settings.bands = {{"0", 0.8}};
  const jobs::DrapeJobReport report = jobs::drape(worn, recorder);
  const jobs::Draped& d = report.garments.at(0);
  double mass = 0;
  const auto map = *geometry::find_map(d.file.mesh, geometry::attribute::mass);
  for (const geometry::Vertex v : d.file.mesh->vertices()) mass += map[v];
  CHECK(d.forces.weight.y() == Approx(-9.81 * mass));
  CHECK((d.forces.weight + d.forces.contact).norm() < 1e-9 * mass);
  REQUIRE(d.forces.bands.size() == 1);
  CHECK(d.forces.bands[0].loop == "0");
  CHECK(std::abs(d.forces.bands[0].tension) < 0.3 * worn.settings.band_stiffness);
  CHECK(to_json(report)["forces"]["bands"][0]["tension"] == d.forces.bands[0].tension);
}

TEST_CASE("drape: without a body a part that no pin holds is named, and nothing at all is refused") {
  tests::Recorder recorder;
  jobs::DrapeJob job = from_its_edge();
  geometry::Mesh& sheet = job.scene.memory.meshes.at("sheet").mesh;
  add(sheet, geometry::equilateral_sheet(0.05, 0.05, 0.02), {0.5, 0, 0});
  const jobs::DrapeJobReport report = jobs::drape(job, recorder);
  CHECK(only(report).outcome() == "at rest, 1 of 2 parts loose");
  CHECK(remarks_on(report, "loose_parts"));
  job.scene.settings.root->erase("pins");
  CHECK_THROWS_WITH(jobs::drape(job, recorder), Catch::Contains("`pin_loop`") && Catch::Contains("`body`"));
}

TEST_CASE("drape: a plate comes to rest on a ball, near to where hinges do, and with friction, too",
          "[long]") {
  tests::Recorder recorder;
  jobs::DrapeJob job = across_ball();
  set(job, "material.bending_law", "hinge");
  const jobs::DrapeJobReport hinges = jobs::drape(job, recorder);
  job.scene.settings.root["material"].erase("bending_law");  // fabrics bend as plates
  const jobs::DrapeJobReport plate = jobs::drape(job, recorder), again = jobs::drape(job, recorder);
  const jobs::Draped a = only(hinges), b = only(plate);
  CHECK(b.outcome().rfind("at rest", 0) == 0);  // as far off the coarse ball as hinges are
  double apart = 0;
  for (const geometry::Vertex v : a.file.mesh->vertices())
    apart = std::max(apart, std::sqrt(CGAL::squared_distance(a.file.mesh->point(v), b.file.mesh->point(v))));
  CAPTURE(apart);
  CHECK(apart > 1e-6);  // another law
  CHECK(apart < 0.05);
  CHECK(without_clock(plate) == without_clock(again));
  job.settings.bending_friction = 1e-5;
  const jobs::Draped stiffer = only(jobs::drape(job, recorder));
  CHECK(stiffer.outcome().rfind("at rest", 0) == 0);
  CHECK(stiffer.report.friction_rounds > 0);
  CHECK(stiffer.report.slip <= 2e-3);
}
