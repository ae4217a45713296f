// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/body/field.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "physics/base/progress.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"
#include "tests/test_meshes.h"

using namespace furrow;
namespace fs = std::filesystem;

TEST_CASE("field: it keeps to its tolerance, and a cancelled or refused job leaves nothing", "[long]") {
  const fs::path folder = tests::empty_folder("field");
  io::MeshFile ball;
  ball.mesh = tests::icosphere(2, 0.1);
  io::write_mesh(folder / "ball.obj", ball);
  jobs::FieldJob job;
  job.body.mesh = folder / "ball.obj";
  job.body.options.tolerance = 0.002;
  job.slice = folder / "ball.png";
  job.at = physics::Vec3(0, 0.15, 0);
  tests::Recorder recorder(1);
  CHECK_THROWS_AS(jobs::field(job, recorder), physics::Cancelled);
  jobs::FieldJob wrong = job;
  wrong.slice = folder / "ball.obj";
  CHECK_THROWS_AS(jobs::field(wrong, recorder), std::invalid_argument);
  CHECK(tests::names_in(folder) == std::set<std::string>{"ball.obj"});
  jobs::Listener nobody;
  const jobs::FieldReport report = jobs::field(job, nobody);
  CHECK(report.errors.points > 1000);
  CHECK(report.errors.largest < 0.004);
  CHECK(to_json(report).at("at").at("distance").get<double>() == Approx(0.05).margin(0.004));
  CHECK(tests::names_in(folder) == std::set<std::string>{"ball.obj", "ball.png"});
}
