// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/cloth/choose_steps.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "geometry/mesh/sheet.h"
#include "io/scene/scene_file.h"
#include "jobs/cloth/scene_cloth.h"
#include "jobs/move/simulate.h"
#include "physics/linear/stable_step.h"
#include "tests/cases/friction.h"
#include "tests/cases/gravity.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"
#include "tests/test_meshes.h"

using namespace furrow;
using physics::Integrator;
namespace fs = std::filesystem;

namespace {

constexpr double edge = 0.05;

/// A hung sheet of 0.4 m with a ridge across it, drawn at `time` [s]; its lines have short edges.
jobs::SimulateJob hung_sheet(double seconds, double time, double stretch, const fs::path& folder) {
  const fs::path strokes = folder / "ridge.json";
  std::ofstream(strokes)
      << R"({"strokes": [{"name": "ridge", "height": 0.01, "points": [[-0.1, 0.2, 0], [0.1, 0.23, 0]]}]})";
  jobs::SimulateJob job;
  job.scene.memory.meshes["sheet"].mesh = geometry::equilateral_sheet(0.4, 0.4, edge);
  job.scene.settings =
      io::parse_toml("[garment]\nmesh = \"sheet\"\n[material]\npreset = \"cotton\"\n", "test");
  io::set_value(job.scene.settings, "material.stretch", stretch, "test");
  io::set_value(job.scene.settings, "pins.0", io::Json{{"box", {-1, 0.399, -1, 1, 1, 1}}}, "test");
  io::set_value(job.scene.settings, "simulation.seconds", seconds, "test");
  io::set_value(job.scene.settings, "lines.0", io::Json{{"strokes", strokes.string()}, {"time", time}},
                "test");
  return job;
}

jobs::SimulateReport run(const jobs::SimulateJob& job) {
  tests::Recorder recorder;
  return jobs::simulate(job, recorder);
}

physics::Cloth sheet_of(double stretch) {
  physics::Cloth cloth;
  const geometry::Mesh mesh = geometry::equilateral_sheet(0.4, 0.4, edge);
  cloth.particles.x.resize(mesh.number_of_vertices());
  const double mass = 0.15 * 0.16 / double(mesh.number_of_vertices());
  for (const geometry::Vertex v : mesh.vertices()) {
    const geometry::Point& p = mesh.point(v);
    cloth.particles.x[v.idx()] = {p.x(), p.y(), p.z()};
  }
  cloth.particles.v.assign(cloth.particles.size(), physics::Vec3::Zero());
  cloth.particles.mass.assign(cloth.particles.size(), mass);
  cloth.particles.inv_mass.assign(cloth.particles.size(), 1 / mass);
  for (const geometry::Edge e : mesh.edges()) {
    const int a = int(mesh.vertex(e, 0).idx()), b = int(mesh.vertex(e, 1).idx());
    cloth.structural.push_back({a, b, (cloth.particles.x[a] - cloth.particles.x[b]).norm(), stretch});
  }
  return cloth;
}

}  // namespace

TEST_CASE("choose_steps: leapfrog, and where its steps are short implicit ones, by predicted costs") {
  const physics::SimulateOptions options;
  const jobs::ChosenSteps soft = jobs::choose_steps(options, sheet_of(100), false);
  CHECK(soft.integrator == Integrator::leapfrog);
  const jobs::ChosenSteps stiff = jobs::choose_steps(options, sheet_of(1e6), false);
  CHECK(stiff.integrator == Integrator::implicit);
  CHECK(stiff.leapfrog > 2 * stiff.implicit);
  CHECK(stiff.implicit == soft.implicit);
  CHECK(stiff.leapfrog == Approx(100 * soft.leapfrog).epsilon(0.05));  // by the root of stiffness
}

TEST_CASE("choose_steps: a step above leapfrog's limit is for implicit steps, unless it is forced") {
  const physics::Cloth cloth = sheet_of(1e6);
  const double limit = physics::stable_step(cloth).dt_limit;
  physics::SimulateOptions options;
  options.dt = 0.99 * limit;
  CHECK(jobs::choose_steps(options, cloth, false).integrator == Integrator::leapfrog);
  options.dt = 1.01 * limit;  // as dear as leapfrog is cheap: refused by that
  CHECK(jobs::choose_steps(options, cloth, false).integrator == Integrator::leapfrog);
  options.dt = 1.0 / 60;
  CHECK(jobs::choose_steps(options, cloth, false).integrator == Integrator::implicit);
  options.dt = 1.0 / 15;
  CHECK(jobs::choose_steps(options, cloth, false).integrator == Integrator::implicit);
  options.dt = 0.1;  // a mistake: leapfrog refuses it
  CHECK(jobs::choose_steps(options, cloth, false).integrator == Integrator::leapfrog);
  options.dt = 1.0 / 60;
  options.step_rule = physics::StepRule::forced;
  CHECK(jobs::choose_steps(options, cloth, false).integrator == Integrator::leapfrog);
}

TEST_CASE("choose_steps: lines of short edges turn leapfrog into implicit steps, stopped before or not") {
  const fs::path folder = tests::empty_folder("chosen_steps");
  const double stretch = 800;
  const jobs::SimulateReport plain = run(hung_sheet(0.06, 1, stretch, folder));
  CHECK(plain.integrator == Integrator::leapfrog);
  REQUIRE(plain.steps);
  CAPTURE(plain.steps->leapfrog, plain.steps->implicit);
  jobs::SimulateJob job = hung_sheet(0.12, 0.06, stretch, folder);
  const jobs::SimulateReport whole = run(job);
  CHECK(whole.integrator == Integrator::implicit);
  REQUIRE(whole.steps);
  CHECK(whole.steps->leapfrog > 2 * whole.steps->implicit);
  CHECK(to_json(whole).at("integrator") == "implicit");
  for (const double stop : {0.03, 0.08}) {
    io::set_value(job.scene.settings, "simulation.stop_at", stop, "test");
    io::set_value(job.scene.settings, "output.state", (folder / "state.ply").string(), "test");
    const jobs::SimulateReport begun = run(job);
    CHECK(begun.integrator == (stop < 0.06 ? Integrator::leapfrog : Integrator::implicit));
    jobs::SimulateJob rest = jobs::resume_from(folder / "state.ply");
    const jobs::SimulateReport resumed = run(rest);
    CHECK(resumed.integrator == Integrator::implicit);
    CHECK(tests::positions(resumed.garment) == tests::positions(whole.garment));
  }
}

TEST_CASE("choose_steps: what is chosen holds and brakes a sheet that lands as Coulomb says") {
  const double stiffness = GENERATE(20.0, 1e4), above = GENERATE(from_range(cases::landing_starts));
  constexpr double degree = 3.14159265358979323846 / 180, friction = 0.37;
  physics::SimulateOptions options;
  options.friction = friction;
  const physics::Cloth cloth = cases::sheet_over_floor(above, options.contact_gap, stiffness);
  options.integrator = jobs::choose_steps(options, cloth, true).integrator;
  CHECK(options.integrator == (stiffness > 1000 ? Integrator::implicit : Integrator::leapfrog));
  CAPTURE(stiffness, above);
  const double angle = std::atan(friction);
  CHECK(cases::slide_of_landing(angle - 0.2 * degree, above, stiffness, options) < 5e-4);
  CHECK(cases::slide_of_landing(angle + 0.2 * degree, above, stiffness, options) > 5e-3);
  CHECK(cases::braking_way(1, above, stiffness, options) ==
        Approx(1 / (2 * friction * cases::gravity)).epsilon(0.01));
}
