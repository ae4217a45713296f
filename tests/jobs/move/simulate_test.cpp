// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/move/simulate.h"

#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <thread>

#include "geometry/fold/fold_base.h"
#include "geometry/mesh/sheet.h"
#include "io/scene/scene.h"
#include "jobs/move/run_warnings.h"
#include "jobs/rest/drape.h"
#include "physics/base/progress.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"
#include "tests/test_meshes.h"

using namespace furrow;
using tests::bytes_of;
using tests::empty_folder;
using tests::names_in;
namespace fs = std::filesystem;

namespace {

/// A sheet of 0.4 m that hangs by its upper border, with a ridge across it, drawn at `time` [s].
jobs::SimulateJob hung_sheet(double seconds, double time = 0) {
  io::DrawnStroke ridge;
  ridge.stroke.name = "ridge";
  ridge.stroke.height = 0.01;
  ridge.stroke.points = {{-0.1, 0.2, 0}, {0.1, 0.2, 0}};
  jobs::SimulateJob job;
  job.scene.memory.meshes["sheet"].mesh = geometry::equilateral_sheet(0.4, 0.4, 0.03);
  job.scene.memory.strokes["ridge"] = {ridge};
  job.scene.settings = io::parse_toml(
      "[garment]\nmesh = \"sheet\"\n[material]\nmembrane = \"paper\"\n[simulation]\ndt = 1e-4\n", "test");
  io::set_value(job.scene.settings, "pins.0", io::Json{{"box", {-1, 0.399, -1, 1, 1, 1}}}, "test");
  io::set_value(job.scene.settings, "simulation.seconds", seconds, "test");
  io::set_value(job.scene.settings, "lines.0", io::Json{{"strokes", "ridge"}, {"time", time}}, "test");
  return job;
}

/// An arm of 0.5 m, 80 mm thick, that hangs down, its lower half turned up by an angle [rad].
geometry::Mesh bent_arm(double angle) {
  constexpr int around = 24, along = 60, steps = 60;
  constexpr double length = 0.5, soft = 0.05, turn = 2 * std::numbers::pi / around;
  const auto heading = [&](double s) { return angle * (std::clamp(s / soft, -1.0, 1.0) + 1) / 2; };
  std::vector<geometry::Point> points, ends;
  std::vector<std::array<int, 3>> faces;
  for (int i = 0; i <= along; ++i) {
    const double s = length * (double(i) / along - 0.5), t = heading(s);
    double down = 0, aside = 0;
    for (int k = 0; k < steps; ++k) {
      down += s / steps * std::cos(heading((k + 0.5) * s / steps));
      aside += s / steps * std::sin(heading((k + 0.5) * s / steps));
    }
    for (int j = 0; j < around; ++j) {
      const double n = 0.04 * std::cos(j * turn), z = 0.04 * std::sin(j * turn);
      points.emplace_back(aside + std::cos(t) * n, std::sin(t) * n - down, z);
    }
    if (i == 0 || i == along) ends.emplace_back(aside, -down, 0);
  }
  points.insert(points.end(), ends.begin(), ends.end());
  const int first = (along + 1) * around, last = first + 1;
  for (int j = 0, k = 1; j < around; ++j, k = (j + 1) % around) {
    for (int a = 0; a < along * around; a += around) {
      faces.push_back({a + j, a + around + k, a + around + j});
      faces.push_back({a + j, a + k, a + around + k});
    }
    faces.push_back({first, k, j});
    faces.push_back({last, along * around + j, along * around + k});
  }
  return tests::mesh_of(points, faces);
}

/// A sleeve after the arm in it has bent by 130 degrees and stretched within 0.8 s, and hung for 0.8 s.
jobs::SimulateReport sleeve_on_arm(const char* self_contact) {
  const fs::path folder = empty_folder("sleeve");
  for (int i = 0; i <= 20; ++i) {
    const double angle = 130 * std::numbers::pi / 360 * (1 - std::cos(i * std::numbers::pi / 10));
    std::ofstream out(folder / ("arm_" + std::to_string(1000 + i) + ".obj"));
    const geometry::Mesh arm = bent_arm(angle);
    for (const geometry::Vertex v : arm.vertices()) out << "v " << arm.point(v) << '\n';
    for (const geometry::Face f : arm.faces()) {
      out << 'f';
      for (const geometry::Vertex v : arm.vertices_around_face(arm.halfedge(f))) out << ' ' << v.idx() + 1;
      out << '\n';
    }
  }
  geometry::Mesh sleeve = tests::cylinder(0.05, 0.3, 28, 36);
  for (const geometry::Vertex v : sleeve.vertices())
    sleeve.point(v) = sleeve.point(v) - geometry::Vector(0, 0.15, 0);
  jobs::SimulateJob job;
  job.scene.memory.meshes["sleeve"].mesh = std::move(sleeve);
  job.scene.settings = io::parse_toml(
      "[garment]\nmesh = \"sleeve\"\nallow_crossings = 100000\n[material]\npreset = \"cotton\"\n"
      "[[pins]]\nloop = \"top\"\n[body]\nfps = 25\n"
      "[simulation]\nintegrator = \"implicit\"\nseconds = 1.6\n",
      "test");
  io::set_value(job.scene.settings, "body.mesh", (folder / "arm_1000.obj").string(), "test");
  io::set_value(job.scene.settings, "body.frames", (folder / "arm_####.obj").string(), "test");
  if (*self_contact) io::set_value(job.scene.settings, "simulation.self_contact", self_contact, "test");
  tests::Recorder recorder;
  return jobs::simulate(job, recorder);
}

/// Counts how often a state is there while the job runs, and checks that it can be read.
class StateWatch : public jobs::Listener {
 public:
  explicit StateWatch(fs::path path) : path_(std::move(path)) {}
  void progress(const std::string& what, double share) override {
    if (what != "simulating" || share >= 1 || !fs::exists(path_)) return;
    CHECK(io::read_state(path_).simulation.step > 0);
    ++seen;
  }
  int seen = 0;

 private:
  fs::path path_;
};

/// A hung sheet over a ball that it swings against.
jobs::SimulateJob sheet_on_ball(double seconds) {
  jobs::SimulateJob job = hung_sheet(seconds);
  job.scene.memory.meshes["ball"].mesh = tests::icosphere(2, 0.1, {0, 0.15, -0.12});
  io::set_value(job.scene.settings, "body.mesh", "ball", "test");
  io::set_value(job.scene.settings, "body.tolerance", 0.005, "test");
  io::set_value(job.scene.settings, "forces.wind", io::Json{0, 0, -3}, "test");
  return job;
}

geometry::Point centre_of(const geometry::Mesh& mesh) {
  geometry::Vector sum(0, 0, 0);
  for (const geometry::Vertex v : mesh.vertices()) sum += mesh.point(v) - CGAL::ORIGIN;
  return CGAL::ORIGIN + sum / double(mesh.number_of_vertices());
}

void set_output(jobs::SimulateJob& job, const std::string& key, const fs::path& path) {
  io::set_value(job.scene.settings, "output." + key, path.string(), "the test");
}

/// Numbers of a report that no clock made.
io::Json without_clock(const jobs::SimulateReport& report) {
  io::Json json = to_json(report);
  json.erase("seconds");
  json.erase("cpu_seconds");
  return json;
}

}  // namespace

TEST_CASE("simulate: RK4 with steps above its limit that comes to its end is no silent success") {
  jobs::SimulateJob job = hung_sheet(0.01);
  io::set_value(job.scene.settings, "simulation.integrator", "rk4", "test");
  tests::Recorder recorder;
  const auto warns = [](const jobs::SimulateReport& report) {
    return std::any_of(report.warnings.begin(), report.warnings.end(),
                       [](const jobs::Warning& w) { return w.code == "step_above_limit"; });
  };
  const jobs::SimulateReport within = jobs::simulate(job, recorder);
  CHECK_FALSE(warns(within));
  const double dt = 1.05 * within.run.dt_limit_smallest;
  io::set_value(job.scene.settings, "simulation.dt", dt, "test");
  io::set_value(job.scene.settings, "simulation.seconds", 20 * dt, "test");
  io::set_value(job.scene.settings, "simulation.force_dt", true, "test");
  const jobs::SimulateReport above = jobs::simulate(job, recorder);
  CHECK(above.run.outcome == physics::Outcome::finished);
  CHECK(warns(above));
}

TEST_CASE("simulate: without damping the kinds of energy and motion sum up to the same at any time") {
  tests::Recorder recorder;
  const auto run = [&](double seconds) {
    jobs::SimulateJob job = hung_sheet(seconds);
    io::set_value(job.scene.settings, "forces.gravity", {0.0, 0.0, -9.81}, "test");
    io::set_value(job.scene.settings, "material.damping", 0, "test");
    io::set_value(job.scene.settings, "material.drag", 0, "test");
    return jobs::simulate(job, recorder);
  };
  const auto sum = [](const jobs::SimulateReport& r) { return r.energy->total() + r.run.kinetic_energy; };
  const jobs::SimulateReport early = run(0.01), late = run(0.2);
  REQUIRE(late.energy);
  CHECK(late.run.kinetic_energy > 0.05 * -late.energy->weight);
  CHECK(late.energy->weight < early.energy->weight - 1e-3);
  CHECK(late.energy->stretch > 0);
  CHECK(std::abs(sum(late) - sum(early)) < 0.01 * std::abs(late.energy->weight - early.energy->weight));
  const jobs::Json json = to_json(late);
  CHECK(json.at("energy").at("kinetic") == json.at("kinetic_energy"));
  CHECK(json["energy"].at("weight") == late.energy->weight);
}

TEST_CASE("simulate: a garment that starts with a velocity flies as a thrown body, and pins hold theirs",
          "[long]") {
  const auto thrown = [](bool pinned, const char* forces) {
    jobs::SimulateJob job = hung_sheet(0.2);
    job.scene.settings = io::parse_toml(
        std::string("[garment]\nmesh = \"sheet\"\nvelocity = [0.3, 0, -0.5]\n[material]\ndrag = 0\n") +
            forces + "[simulation]\ndt = 1e-4\nseconds = 0.2\n",
        "test");
    if (pinned)
      io::set_value(job.scene.settings, "pins.0", io::Json{{"box", {-1, 0.399, -1, 1, 1, 1}}}, "test");
    tests::Recorder recorder;
    const auto before = tests::positions(job.scene.memory.meshes["sheet"]);
    const auto after = tests::positions(jobs::simulate(job, recorder).garment);
    REQUIRE(after.size() == before.size());
    std::vector<Eigen::Vector3d> moved;
    for (std::size_t i = 0; i < after.size(); ++i)
      moved.emplace_back(after[i].x() - before[i].x(), after[i].y() - before[i].y(),
                         after[i].z() - before[i].z());
    return moved;
  };
  for (const auto& way : thrown(false, "[forces]\ngravity = 0\n"))
    CHECK((way - Eigen::Vector3d(0.06, 0, -0.1)).norm() < 1e-12);
  for (const auto& way : thrown(false, ""))
    CHECK((way - Eigen::Vector3d(0.06, -0.5 * 9.81 * 0.04, -0.1)).norm() < 1e-10);
  const auto held = thrown(true, "[forces]\ngravity = 0\n");
  CHECK(std::count_if(held.begin(), held.end(), [](const auto& way) { return way.norm() == 0; }) >= 10);
  CHECK(std::count_if(held.begin(), held.end(), [](const auto& way) { return way.z() < -0.01; }) > 50);
}

TEST_CASE("simulate: a garment and strokes in memory come to the bits of their files") {
  const fs::path folder = empty_folder("memory");
  tests::Recorder recorder;
  const jobs::SimulateJob in_memory = hung_sheet(0.02);
  jobs::SimulateJob of_files = in_memory;
  io::write_mesh(folder / "sheet.ply", in_memory.scene.memory.meshes.at("sheet"));
  std::ofstream(folder / "ridge.json")
      << R"({"strokes": [{"name": "ridge", "height": 0.01, "points": [[-0.1, 0.2, 0], [0.1, 0.2, 0]]}]})";
  of_files.scene.memory = {};
  io::set_value(of_files.scene.settings, "garment.mesh", (folder / "sheet.ply").string(), "the test");
  io::set_value(of_files.scene.settings, "lines.0.strokes", (folder / "ridge.json").string(), "the test");
  const jobs::SimulateReport a = jobs::simulate(in_memory, recorder), b = jobs::simulate(of_files, recorder);
  REQUIRE(a.shape);
  CHECK(a.run.outcome == physics::Outcome::finished);
  CHECK(a.rounds.size() == 1);
  CHECK(a.shape->lines.size() == 1);
  CHECK(tests::positions(a.garment) == tests::positions(b.garment));
  CHECK(without_clock(a) == without_clock(b));
  CHECK(recorder.warnings.empty());
}

TEST_CASE("simulate: two jobs at once in one process give the bits of single runs", "[long]") {
  tests::Recorder recorder;
  const jobs::SimulateJob one = hung_sheet(0.05, 0.02), two = sheet_on_ball(0.05);
  const jobs::SimulateReport single_one = jobs::simulate(one, recorder),
                             single_two = jobs::simulate(two, recorder);
  tests::Recorder first, second;
  jobs::SimulateReport report_one, report_two;
  std::thread beside([&] { report_one = jobs::simulate(one, first); });
  report_two = jobs::simulate(two, second);
  beside.join();
  CHECK(tests::positions(report_one.garment) == tests::positions(single_one.garment));
  CHECK(tests::positions(report_two.garment) == tests::positions(single_two.garment));
  CHECK(without_clock(report_one) == without_clock(single_one));
  CHECK(without_clock(report_two) == without_clock(single_two));
}

TEST_CASE("simulate: a job that is cancelled ends with the next question and leaves whole files or none",
          "[long]") {
  const fs::path folder = empty_folder("cancelled");
  jobs::SimulateJob job = hung_sheet(0.1);
  for (const char* key : {"mesh", "state"}) set_output(job, key, folder / (std::string(key) + ".ply"));
  set_output(job, "animation", folder / "run.pc2");
  tests::Recorder whole;
  const jobs::SimulateReport reference = jobs::simulate(job, whole);
  REQUIRE(reference.run.outcome == physics::Outcome::finished);
  const std::set<std::string> all{"mesh.ply", "run.pc2", "state.ply"};
  REQUIRE(names_in(folder) == all);
  int before_anything = 0, on_the_way = 0;
  const int last = whole.asked - 80;
  const auto step = [&](int at) { return std::max(1, std::min(whole.asked / 20, last - at)); };
  for (int cancel_at = 1; cancel_at < whole.asked; cancel_at += step(cancel_at)) {
    for (const std::string& name : all) fs::remove(folder / name);
    tests::Recorder recorder(cancel_at);
    try {
      const jobs::SimulateReport report = jobs::simulate(job, recorder);
      CHECK(report.run.outcome == physics::Outcome::stopped_by_observer);
      CHECK(names_in(folder) == all);
      CHECK_NOTHROW(io::read_mesh(folder / "mesh.ply"));
      CHECK(io::read_state(folder / "state.ply").simulation.time == report.run.time);
      ++on_the_way;
    } catch (const physics::Cancelled&) {
      CHECK(names_in(folder).empty());
      ++before_anything;
    }
    CHECK(recorder.asked == cancel_at);
  }
  CHECK(before_anything > 0);
  CHECK(on_the_way > 5);
}

TEST_CASE("simulate: a job that is cancelled while the body's field is built writes nothing") {
  const fs::path folder = empty_folder("cancelled_field");
  jobs::SimulateJob job = sheet_on_ball(0.05);
  set_output(job, "mesh", folder / "mesh.ply");
  for (const int cancel_at : {3, 4, 5}) {
    tests::Recorder recorder(cancel_at);
    CHECK_THROWS_AS(jobs::simulate(job, recorder), physics::Cancelled);
    CHECK(recorder.asked == cancel_at);
  }
  CHECK(names_in(folder).empty());
}

TEST_CASE("simulate: what was cancelled goes on to the bits of a run that was not") {
  const fs::path folder = empty_folder("resumed");
  tests::Recorder whole;
  jobs::SimulateJob job = hung_sheet(0.05);
  set_output(job, "state", folder / "state.ply");
  const jobs::SimulateReport reference = jobs::simulate(job, whole);
  tests::Recorder impatient(whole.asked - 1);
  REQUIRE(jobs::simulate(job, impatient).run.outcome == physics::Outcome::stopped_by_observer);
  jobs::SimulateJob rest = jobs::resume_from(folder / "state.ply");
  tests::Recorder recorder;
  const jobs::SimulateReport report = jobs::simulate(rest, recorder);
  CHECK(report.run.outcome == physics::Outcome::finished);
  CHECK(tests::positions(report.garment) == tests::positions(reference.garment));
}

TEST_CASE("simulate: a state written on the way changes no bit, and a run goes on from it") {
  const fs::path folder = empty_folder("checkpoints");
  tests::Recorder recorder;
  jobs::SimulateJob job = hung_sheet(0.1, 0.05);
  const jobs::SimulateReport reference = jobs::simulate(job, recorder);
  set_output(job, "state", folder / "state.ply");
  io::set_value(job.scene.settings, "output.checkpoint", 1e-9, "test");  // whenever the run is observed
  StateWatch watch(folder / "state.ply");
  const jobs::SimulateReport report = jobs::simulate(job, watch);
  CHECK(watch.seen > 0);
  CHECK(report.run.steps == reference.run.steps);
  CHECK(tests::positions(report.garment) == tests::positions(reference.garment));
  job.scene.settings = hung_sheet(0.1, 0.05).scene.settings;
  io::set_value(job.scene.settings, "output.checkpoint", 60.0, "test");
  CHECK_THROWS_AS(jobs::simulate(job, recorder), std::invalid_argument);  // no state to write
}

TEST_CASE("simulate: a job that cannot be is refused, and writes nothing") {
  const fs::path folder = empty_folder("refused");
  tests::Recorder recorder;
  jobs::SimulateJob job = hung_sheet(0.02);
  job.needs_output = true;
  CHECK_THROWS_AS(jobs::simulate(job, recorder), std::invalid_argument);
  set_output(job, "mesh", folder / "mesh.gltf");
  CHECK_THROWS_AS(jobs::simulate(job, recorder), std::invalid_argument);
  set_output(job, "mesh", folder / "there" / "is" / "none.ply");
  CHECK_THROWS_AS(jobs::simulate(job, recorder), std::runtime_error);
  set_output(job, "mesh", folder / "mesh.ply");
  io::set_value(job.scene.settings, "simulation.dt", 1.0, "test");
  io::set_value(job.scene.settings, "simulation.integrator", "leapfrog", "test");
  CHECK_THROWS_AS(jobs::simulate(job, recorder), std::invalid_argument);
  CHECK(names_in(folder).empty());
}

TEST_CASE("simulate: warnings have codes that say what they are about") {
  tests::Recorder recorder;
  const jobs::SimulateReport report = jobs::simulate(hung_sheet(0.02, 0.5), recorder);
  REQUIRE(recorder.warned_of("lines_after_end"));
  CHECK(recorder.warnings[0].where == "ridge");
  CHECK(recorder.warnings[0].help == "simulation.seconds");
  jobs::SimulateJob gusts = hung_sheet(0.02);
  io::set_value(gusts.scene.settings, "forces.gusts.0", io::Json{{"time", 0.5}, {"factor", 2.0}}, "test");
  const std::vector<jobs::Warning> remarks = jobs::simulate(gusts, recorder).warnings;
  REQUIRE(remarks.size() == 1);
  CHECK(remarks[0].code == "gusts_without_wind");
  CHECK(remarks[0].help == "forces.wind");
  CHECK(report.rounds.empty());
}

TEST_CASE("simulate: damping of springs that an integrator does not have is warned of where it was asked for",
          "[long]") {
  tests::Recorder recorder;
  jobs::SimulateJob job = hung_sheet(0.02);
  const auto codes = [&] {
    std::vector<std::string> all;
    for (const jobs::Warning& w : jobs::simulate(job, recorder).warnings) all.push_back(w.code);
    return all;
  };
  io::set_value(job.scene.settings, "simulation.integrator", "implicit", "test");
  CHECK(codes().empty());
  io::set_value(job.scene.settings, "material.damping", 0.5, "test");
  CHECK(codes() == std::vector<std::string>{"damping_unused"});
  io::set_value(job.scene.settings, "simulation.integrator", "leapfrog", "test");
  CHECK(codes().empty());
}

TEST_CASE("simulate: a line that fades or turns over is warned of by name, with figures and what helps",
          "[long]") {
  jobs::SimulateJob job = hung_sheet(0.5);
  io::set_value(job.scene.settings, "forces.gravity", 1000, "test");  // draws the sheet taut
  tests::Recorder recorder;
  const jobs::SimulateReport faded = jobs::simulate(job, recorder);
  REQUIRE(faded.shape->lines.size() == 1);
  REQUIRE(faded.shape->lines[0].kept.has_value());
  REQUIRE(*faded.shape->lines[0].kept < 0.5);
  const auto lost = [](const jobs::SimulateReport& report) -> const jobs::Warning* {
    for (const jobs::Warning& w : report.warnings)
      if (w.code == "lines_lost") return &w;
    return nullptr;
  };
  REQUIRE(lost(faded));
  CHECK(lost(faded)->where == "ridge");
  CHECK(lost(faded)->help == "`furrow keep`");
  CHECK(lost(faded)->text.find("the line lost more than half of its height: 'ridge' ") == 0);
  CHECK(lost(faded)->text.find(" mm)") != std::string::npos);
  const jobs::SimulateReport fresh = jobs::simulate(hung_sheet(0.001), recorder);
  REQUIRE(*fresh.shape->lines[0].kept > 0.5);
  CHECK_FALSE(lost(fresh));
}

TEST_CASE("simulate: --rest keep takes the fabric that the garment's file notes, as keep does", "[long]") {
  const fs::path folder = empty_folder("simulate_noted");
  tests::Recorder recorder;
  jobs::SimulateJob first = hung_sheet(0.001);
  io::set_value(first.scene.settings, "material.preset", "denim", "test");
  set_output(first, "mesh", folder / "worn.ply");
  jobs::simulate(first, recorder);
  jobs::SimulateJob second;
  second.scene.settings = io::parse_toml("[garment]\nrest = \"keep\"\n[simulation]\ndt = 1e-5\n", "test");
  io::set_value(second.scene.settings, "garment.mesh", (folder / "worn.ply").string(), "the test");
  io::set_value(second.scene.settings, "simulation.seconds", 0.001, "test");
  io::set_value(second.scene.settings, "pins.0", io::Json{{"box", {-1, 0.39, -1, 1, 1, 1}}}, "test");
  const jobs::SimulateReport kept = jobs::simulate(second, recorder);
  CHECK(kept.kept.has_value());
  CHECK(kept.settings["material"]["preset"] == "denim");
}

TEST_CASE("simulate: integrator and step are chosen for a tolerance, and named in the settings", "[long]") {
  tests::Recorder recorder;
  jobs::SimulateJob job = hung_sheet(0.05);
  job.tolerance = 0.01;
  job.budget = 20;
  const jobs::SimulateReport report = jobs::simulate(job, recorder);
  REQUIRE(report.choice);
  REQUIRE(report.ran);
  CHECK(report.settings["simulation"].contains("integrator"));
  CHECK(to_json(report).contains("choice"));
}

namespace {

/// A tube around a ball that is too thick for it: it starts inside.
jobs::SimulateJob tube_in_ball(double radius) {
  jobs::SimulateJob job;
  geometry::Mesh& tube = job.scene.memory.meshes["tube"].mesh;
  tube = tests::cylinder(radius, 0.1, 32, 10);
  for (geometry::Point& p : tube.points()) p = {p.x(), p.y() - 0.05, p.z()};
  job.scene.memory.meshes["ball"].mesh = tests::icosphere(3, 0.2);
  job.scene.settings = io::parse_toml("[garment]\nmesh = \"tube\"\n[simulation]\nseconds = 0.2\n", "test");
  io::set_value(job.scene.settings, "body.mesh", "ball", "test");
  io::set_value(job.scene.settings, "body.tolerance", 0.001, "test");
  return job;
}

bool has_fault(const jobs::SimulateReport& report, const std::string& code) {
  return std::any_of(report.faults.begin(), report.faults.end(),
                     [&](const jobs::Fault& f) { return f.told.code == code; });
}

}  // namespace

TEST_CASE("simulate: cloth that ends inside the body is no success, and where it lies is said", "[long]") {
  tests::Recorder recorder;
  const jobs::SimulateReport report = jobs::simulate(tube_in_ball(0.1), recorder);
  INFO(to_json(report).dump(1));
  REQUIRE(report.shape);
  REQUIRE(report.shape->contact->inside.inside > 0);
  CHECK(recorder.warned_of("starts_inside"));
  CHECK(has_fault(report, "inside_body"));
  CHECK(report.fails());
  CHECK(report.outcome().find("inside the body") != std::string::npos);
  CHECK(0.2 - report.shape->contact->deepest_at.norm() ==
        Approx(report.shape->contact->inside.deepest).margin(0.004));  // the ball has faces
}

TEST_CASE("simulate: cloth strained beyond twice its length is torn") {
  tests::Recorder recorder;
  jobs::SimulateJob job = hung_sheet(0.4);
  job.scene.settings.root->erase("lines");
  io::set_value(job.scene.settings, "material.stiffness", 0.05, "test");
  io::set_value(job.scene.settings, "material.bending", 0, "test");
  const jobs::SimulateReport report = jobs::simulate(job, recorder);
  INFO(to_json(report).dump(1));
  REQUIRE(report.run.strain.p99 > 1);
  CHECK(has_fault(report, "torn"));
  CHECK(report.outcome() == "torn");
  CHECK(report.fails());
}

TEST_CASE("simulate: cloth that falls through other cloth is counted, new or from the start") {
  tests::Recorder recorder;
  jobs::SimulateJob job = hung_sheet(0.1);
  job.scene.settings.root->erase("lines");
  job.scene.settings.root["simulation"].erase("dt");
  geometry::Mesh& sheet = job.scene.memory.meshes["sheet"].mesh;
  sheet.add_face(sheet.add_vertex({0.1, 0.3, -0.05}), sheet.add_vertex({0.1, 0.3, 0.05}),
                 sheet.add_vertex({0.12, 0.3, 0}));  // through the sheet; it falls
  const jobs::SimulateReport report = jobs::simulate(job, recorder);
  INFO(to_json(report).dump(1));
  REQUIRE(report.shape);
  CHECK(report.shape->crossings.at_start.value() > 0);
  CHECK(report.shape->crossings.pairs > 0);
  CHECK(report.shape->crossings.from_start < report.shape->crossings.pairs);
  CHECK(to_json(report).at("self_intersections") == report.shape->crossings.pairs);
  CHECK(has_fault(report, "cloth_crosses"));
  CHECK(report.outcome() == "finished, cloth crosses itself");
  io::set_value(job.scene.settings, "garment.allow_crossings", report.shape->crossings.pairs, "test");
  CHECK_FALSE(jobs::simulate(job, recorder).fails());
}

TEST_CASE("simulate: folds of a bending arm iron out farther where no cloth passes through cloth",
          "[release]") {
  const jobs::SimulateReport by_default = sleeve_on_arm(""), without = sleeve_on_arm("off");
  REQUIRE((by_default.shape && without.shape));
  CHECK(by_default.shape->crossings.pairs == 0);
  CHECK(without.shape->crossings.pairs > 20);
  const double ironed = geometry::angle_defect(by_default.garment.mesh);
  CAPTURE(ironed);
  CHECK(geometry::angle_defect(without.garment.mesh) > 2 * ironed);
}

TEST_CASE("simulate: with contact of cloth with itself --cloth-friction holds a sheet on a slope of cloth") {
  const auto level = [](double size, double y) {
    geometry::Mesh sheet = geometry::equilateral_sheet(size, size, 0.03);
    for (const geometry::Vertex v : sheet.vertices()) {
      const geometry::Point p = sheet.point(v);
      sheet.point(v) = {p.x(), y, p.y()};
    }
    return sheet;
  };
  const auto slid_by = [&](double friction) {
    jobs::SimulateJob job;
    geometry::Mesh both = level(0.3, 0);
    tests::append(both, level(0.12, 0.001));
    const double start = centre_of(both).x();
    job.scene.memory.meshes["sheets"].mesh = std::move(both);
    job.scene.settings = io::parse_toml(
        "[garment]\nmesh = \"sheets\"\n[[pins]]\nbox = [-1, -1, -1, 1, 0.0005, 1]\n"
        "[forces]\ngravity = [2.5, -9.5, 0]\n"
        "[simulation]\nintegrator = \"implicit\"\nself_contact = \"on\"\nseconds = 0.2\n",
        "test");
    io::set_value(job.scene.settings, "material.cloth_friction", friction, "test");
    io::set_value(job.scene.settings, "garment.attach", false, "test");
    io::set_value(job.scene.settings, "material.drag", 0, "test");
    tests::Recorder recorder;
    const jobs::SimulateReport report = jobs::simulate(job, recorder);
    return (centre_of(report.garment.mesh).x() - start) * double(report.garment.mesh->number_of_vertices());
  };
  const double smooth = slid_by(0), rough = slid_by(0.5);
  CHECK(smooth > 10 * std::abs(rough));
}

TEST_CASE("simulate: what is led out of the gap goes on after a stop with the bits of one run", "[long]") {
  const fs::path folder = empty_folder("led_out");
  jobs::SimulateJob job = sheet_on_ball(0.1);
  job.scene.memory.meshes["ball"].mesh =
      tests::icosphere(2, 0.1, {0, 0.15, -0.1005});  // half a millimetre away
  job.scene.settings.root->erase("lines");
  io::set_value(job.scene.settings, "simulation.integrator", "implicit", "test");
  io::set_value(job.scene.settings, "simulation.dt", 0.002, "test");
  tests::Recorder recorder;
  const jobs::SimulateReport whole = jobs::simulate(job, recorder);
  io::set_value(job.scene.settings, "simulation.stop_at", 0.005, "test");
  set_output(job, "state", folder / "state.ply");
  jobs::simulate(job, recorder);
  const io::SavedState state = io::read_state(folder / "state.ply");
  CHECK(std::ranges::any_of(state.simulation.steps.anchors, [](const auto& a) { return a.nearer > 0; }));
  jobs::SimulateJob rest = jobs::resume_from(folder / "state.ply");
  rest.scene.memory = job.scene.memory;
  io::set_value(rest.scene.settings, "body.mesh", "ball", "test");
  CHECK(tests::positions(jobs::simulate(rest, recorder).garment) == tests::positions(whole.garment));
}

TEST_CASE("simulate: a run that diverged is told what helps, and nothing of a body that it has not") {
  physics::SimulateReport run;
  run.dt = 3.6e-5;
  io::Scene scene;
  CHECK_THAT(jobs::words_of_divergence(scene, run), Catch::EndsWith("; take shorter steps: `dt=1e-05`"));
  scene.body.emplace();
  CHECK_THAT(jobs::words_of_divergence(scene, run),
             Catch::EndsWith("inside the body, or take shorter steps: `dt=1e-05`"));
  scene.simulation.dt = 1e-3;
  CHECK_THAT(jobs::words_of_divergence(scene, run), Catch::EndsWith("leave out `dt`"));
}

TEST_CASE("simulate: what was stretched on the way is told where the end does not show it") {
  physics::SimulateReport run;
  run.steps = 30;
  run.strain.max = 0.3;
  run.longest_edge = {0.62, 0.21, {0.1, 1.2, -0.3}};
  const std::vector<jobs::Warning> odd = jobs::oddities_of({}, run);
  REQUIRE(odd.size() == 1);
  CHECK(odd[0].code == "stretched_on_the_way");
  CHECK_THAT(odd[0].text, Catch::Contains("62 % at 0.21 s, near (0.10, 1.20, -0.30) m"));
  run.strain.max = 0.4;  // half of it is still seen
  CHECK(jobs::oddities_of({}, run).empty());
  run = {};
  run.longest_edge.strain = 0.49;
  CHECK(jobs::oddities_of({}, run).empty());
}

TEST_CASE("simulate: steps that were not solved are told, and more than a tenth of all are no success") {
  physics::SimulateReport run;
  run.steps = 30;
  run.open_steps = 3;
  const std::vector<jobs::Warning> odd = jobs::oddities_of({}, run);
  REQUIRE(odd.size() == 1);
  CHECK(odd[0].code == "steps_open");
  CHECK_FALSE(jobs::unsolved_steps(run));
  run.open_steps = 4;
  CHECK(jobs::oddities_of({}, run).empty());
  const auto fault = jobs::unsolved_steps(run);
  REQUIRE(fault);
  CHECK(fault->word == "steps not solved");
  CHECK_THAT(fault->told.text, Catch::Contains("4 of 30 steps"));
  jobs::SimulateReport report;
  report.faults.push_back(*fault);
  CHECK(report.fails());
  CHECK(report.outcome() == "finished, steps not solved");
}

TEST_CASE("simulate: a gap that edges raise is told, and the advice lowers it", "[release]") {
  tests::Recorder recorder;
  jobs::SimulateJob job = sheet_on_ball(0.005);
  job.scene.settings.root->erase("lines");
  io::set_value(job.scene.settings, "body.tolerance", 0.0002, "test");
  io::set_value(job.scene.settings, "material.gap", 0.0008, "test");
  const auto told = [](const jobs::SimulateReport& report) {
    return std::any_of(report.warnings.begin(), report.warnings.end(),
                       [](const jobs::Warning& w) { return w.code == "gap_raised"; });
  };
  const jobs::SimulateReport coarse = jobs::simulate(job, recorder);
  CHECK(told(coarse));
  CHECK(coarse.shape->contact->gap > 0.0012);
  io::set_value(job.scene.settings, "garment.subdivide", 1, "test");
  job.scene.settings.root["simulation"].erase("dt");  // finer springs want a shorter step
  CHECK_FALSE(told(jobs::simulate(job, recorder)));
}

namespace {

/// The same sheet in cotton, which comes to rest first.
jobs::SimulateJob settled_sheet(double seconds, double time = 0) {
  jobs::SimulateJob job = hung_sheet(seconds, time);
  job.scene.settings.root["simulation"].erase("dt");
  job.scene.settings.root["material"].erase("membrane");
  io::set_value(job.scene.settings, "simulation.settle", true, "test");
  io::set_value(job.scene.settings, "material.preset", "cotton", "test");
  return job;
}

double farthest_apart(const io::MeshFile& a, const io::MeshFile& b) {
  REQUIRE(a.mesh->number_of_vertices() == b.mesh->number_of_vertices());
  double most = 0;
  for (const geometry::Vertex v : a.mesh->vertices())
    most = std::max(most, CGAL::squared_distance(a.mesh->point(v), b.mesh->point(v)));
  return std::sqrt(most);
}

}  // namespace

TEST_CASE(
    "simulate: with settle the drawn sheet comes to rest as drape lets it, and with no seconds that is all",
    "[long]") {
  const fs::path folder = empty_folder("simulate_settle");
  tests::Recorder recorder;
  jobs::SimulateJob job = settled_sheet(0);
  set_output(job, "smoothed", folder / "drawn.ply");
  set_output(job, "settled", folder / "rests.ply");
  const jobs::SimulateReport report = jobs::simulate(job, recorder);
  INFO(to_json(report).dump(1));
  CHECK(report.outcome() == "at rest");
  CHECK_FALSE(report.fails());
  REQUIRE(report.rest);
  CHECK(report.rest->settle.converged);
  CHECK(report.rest->settle.residual <= 1e-3);
  CHECK(report.rest->angle_defect_before > 0);
  CHECK(to_json(report)["at_rest"]["angle_defect"].get<double>() == report.rest->angle_defect);
  CHECK(tests::positions(io::read_mesh(folder / "rests.ply")) == tests::positions(report.garment));
  jobs::DrapeJob drape;
  drape.scene.settings = io::parse_toml("[garment]\n[material]\npreset = \"cotton\"\n", "test");
  io::set_value(drape.scene.settings, "garment.mesh", (folder / "drawn.ply").string(), "test");
  io::set_value(drape.scene.settings, "pins", job.scene.settings.root["pins"], "test");
  const jobs::DrapeJobReport draped = jobs::drape(drape, recorder);
  CHECK(farthest_apart(draped.garments.at(0).file, report.garment) < 1e-9);
}

TEST_CASE("simulate: what came to rest hardly moves, and lines that come later are drawn into it", "[long]") {
  const fs::path folder = empty_folder("simulate_settle_moves");
  tests::Recorder recorder;
  jobs::SimulateJob job = settled_sheet(0.05);
  set_output(job, "settled", folder / "rests.ply");
  const jobs::SimulateReport moved = jobs::simulate(job, recorder);
  CHECK(moved.outcome() == "finished");
  CHECK(farthest_apart(io::read_mesh(folder / "rests.ply"), moved.garment) < 1e-4);
  io::set_value(job.scene.settings, "simulation.settle", false, "test");
  job.scene.settings.root["output"].erase("settled");
  const jobs::SimulateReport falls = jobs::simulate(job, recorder);
  CHECK(farthest_apart(io::read_mesh(folder / "rests.ply"), falls.garment) > 2e-4);
  const jobs::SimulateReport later = jobs::simulate(settled_sheet(0.01, 0.005), recorder);
  REQUIRE(later.rest);
  CHECK(later.rest->settle.converged);
  CHECK(later.rounds.size() == 1);
  CHECK(later.rounds[0].time == Approx(0.005).margin(5e-4));
  CHECK(later.outcome() == "finished");
}

TEST_CASE(
    "simulate: settle without anything that holds the garment is refused, and what falls is not at rest",
    "[long]") {
  tests::Recorder recorder;
  jobs::SimulateJob job = settled_sheet(0);
  job.scene.settings.root->erase("pins");
  CHECK_THROWS_WITH(jobs::simulate(job, recorder), Catch::Contains("`pin_loop`"));
  job.scene.memory.meshes["ball"].mesh = tests::icosphere(2, 0.1, {0, -6, 0});
  io::set_value(job.scene.settings, "body.mesh", "ball", "test");
  io::set_value(job.scene.settings, "body.tolerance", 0.005, "test");
  const jobs::SimulateReport falls = jobs::simulate(job, recorder);
  CHECK(falls.outcome() == "not at rest");
  CHECK(falls.fails());
  REQUIRE(falls.faults.size() == 1);
  CHECK(falls.faults[0].told.code == "not_at_rest");
  job = settled_sheet(0);
  io::set_value(job.scene.settings, "simulation.settle", false, "test");
  set_output(job, "settled", empty_folder("simulate_not_settled") / "rests.ply");
  CHECK_THROWS_WITH(jobs::simulate(job, recorder), Catch::Contains("output.settled needs settle"));
}

TEST_CASE(
    "simulate: where the body comes through between vertices is reported, and no success where it is deep") {
  for (const double depth : {0.0018, 0.008}) {
    tests::Recorder recorder;
    jobs::SimulateJob job;
    geometry::Mesh& sheet = job.scene.memory.meshes["sheet"].mesh;
    sheet = geometry::equilateral_sheet(0.6, 0.6, 0.2);  // no vertex above the ball's top
    for (geometry::Point& p : sheet.points()) p = {p.x() + 0.07, 0.1 - depth, p.y() - 0.31};
    job.scene.memory.meshes["ball"].mesh = tests::icosphere(4, 0.1);
    job.scene.settings =
        io::parse_toml("[garment]\nmesh = \"sheet\"\n[simulation]\nseconds = 0.01\n", "test");
    io::set_value(job.scene.settings, "body.mesh", "ball", "test");
    io::set_value(job.scene.settings, "body.tolerance", 0.005, "test");
    io::set_value(job.scene.settings, "pins.0", io::Json{{"box", {-9, -9, -9, 9, 9, 9}}}, "test");
    const jobs::SimulateReport report = jobs::simulate(job, recorder);
    INFO(to_json(report).dump(1));
    REQUIRE(report.shape);
    REQUIRE(report.shape->end.body);
    CHECK(report.shape->end.body->pierced_faces > 0);
    CHECK(report.shape->end.body->vertices_inside == 0);
    CHECK(report.shape->end.body->depth == Approx(depth).margin(0.0003));
    const bool warned = std::any_of(report.warnings.begin(), report.warnings.end(),
                                    [](const jobs::Warning& w) { return w.code == "body_comes_through"; });
    CHECK(warned == (depth < 0.005));
    CHECK(report.fails() == (depth > 0.005));
    CHECK((report.outcome().find("pierced by the body") != std::string::npos) == (depth > 0.005));
    CHECK(to_json(report).at("end").at("body").at("depth") == report.shape->end.body->depth);
  }
}
