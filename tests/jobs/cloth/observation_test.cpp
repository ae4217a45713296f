// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/cloth/observation.h"

#include <catch2/catch.hpp>
#include <cstring>
#include <nlohmann/json.hpp>
#include <vector>

#include "geometry/mesh/sheet.h"
#include "jobs/move/simulate.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"

using namespace furrow;
using physics::Integrator;

namespace {

/// A sheet that falls freely from rest, without drag.
jobs::SimulateJob falling_sheet(const std::string& steps) {
  jobs::SimulateJob job;
  job.scene.memory.meshes["sheet"].mesh = geometry::equilateral_sheet(0.1, 0.1, 0.05);
  job.scene.settings =
      io::parse_toml("[garment]\nmesh = \"sheet\"\n[material]\ndrag = 0\n[simulation]\n" + steps, "test");
  return job;
}

/// How far the first vertex lies below where it began, in each frame of a PC2 file [m].
std::vector<double> falls(const std::filesystem::path& path) {
  const std::string bytes = tests::bytes_of(path);
  std::int32_t points = 0, frames = 0;
  std::memcpy(&points, bytes.data() + 16, 4);
  std::memcpy(&frames, bytes.data() + 28, 4);
  std::vector<double> all;
  float first = 0;
  for (int i = 0; i < frames; ++i) {
    float y = 0;
    std::memcpy(&y, bytes.data() + 32 + 12 * std::size_t(i) * std::size_t(points) + 4, 4);
    if (i == 0) first = y;
    all.push_back(double(first) - y);
  }
  return all;
}

std::vector<double> falls_of(jobs::SimulateJob job, double fps) {
  const auto folder = tests::empty_folder("observation");
  io::set_value(job.scene.settings, "output.animation", (folder / "fall.pc2").string(), "test");
  io::set_value(job.scene.settings, "output.fps", fps, "test");
  tests::Recorder recorder;
  REQUIRE(jobs::simulate(job, recorder).run.outcome == physics::Outcome::finished);
  return falls(folder / "fall.pc2");
}

}  // namespace

TEST_CASE("observation: an animation shows each implicit step") {
  const double dt = 1.0 / 60, g = 9.81;
  const std::vector<double> fallen =
      falls_of(falling_sheet("integrator = \"implicit\"\nseconds = 0.5\n"), 60);
  REQUIRE(fallen.size() == 31);
  for (std::size_t i = 0; i < fallen.size(); ++i)  // backward Euler's sum
    CHECK(fallen[i] == Approx(g * dt * dt * double(i * (i + 1)) / 2).margin(1e-6));
}

TEST_CASE("observation: frames between long steps of leapfrog and XPBD lie on the motion") {
  const double g = 9.81;
  for (const char* steps :
       {"integrator = \"leapfrog\"\nseconds = 0.5\n", "integrator = \"xpbd\"\nseconds = 0.5\n"}) {
    CAPTURE(steps);
    jobs::SimulateJob job = falling_sheet(steps);
    for (const char* key : {"stiffness", "bending"})
      io::set_value(job.scene.settings, std::string("material.") + key, 0.01, "test");
    const std::vector<double> fallen = falls_of(job, 50);
    REQUIRE(fallen.size() == 26);
    for (std::size_t i = 0; i < fallen.size(); ++i)  // XPBD is off by g t dt / 2
      CHECK(fallen[i] == Approx(g * double(i * i) / (2 * 50 * 50)).margin(1.01 * 0.5 * g / 1200 / 2));
  }
}

TEST_CASE("observation: it is by counts, and an animation looks at least once in 1/240 s, or at each step") {
  physics::Cloth cloth;
  cloth.particles.x.assign(100, physics::Vec3::Zero());
  physics::SimulateOptions options;
  options.dt = 1e-4;
  const jobs::Observation plain = jobs::observation_of(options, cloth, false, false);
  CHECK(plain.steps == 100);
  const jobs::Observation seen = jobs::observation_of(options, cloth, false, true);
  CHECK(seen.shown == 20);
  CHECK(seen.steps == 20);
  options.dt = 1e-5;
  CHECK(jobs::observation_of(options, cloth, false, true).shown == 100);
  options.dt = 1e-3;
  CHECK(jobs::observation_of(options, cloth, false, true).shown == 2);
  options.dt = 0.02;
  CHECK(jobs::observation_of(options, cloth, false, true).shown == 1);
  options.dt.reset();
  options.integrator = Integrator::tr_bdf2;
  const jobs::Observation implicit = jobs::observation_of(options, cloth, false, true);
  CHECK(implicit.shown == 1);
  CHECK(implicit.steps == 1);
}
