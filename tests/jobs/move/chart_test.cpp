// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/move/chart.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "geometry/mesh/sheet.h"
#include "io/scene/scene.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"

using namespace furrow;
namespace fs = std::filesystem;

namespace {

jobs::ChartJob chart_of_hung_sheet(const std::string& simulation = "") {
  jobs::ChartJob job;
  job.scene.memory.meshes["sheet"].mesh = geometry::equilateral_sheet(0.4, 0.4, 0.05);
  job.scene.settings = io::parse_toml(
      "[garment]\nmesh = \"sheet\"\n[[pins]]\nbox = [-1, 0.399, -1, 1, 1, 1]\n[simulation]\nseconds = 0.2\n" +
          simulation,
      "test");
  job.name = "hung sheet";
  return job;
}

}  // namespace

TEST_CASE("chart: the choice is the same from call to call, and the numbers are written") {
  const fs::path folder = tests::empty_folder("chart");
  tests::Recorder recorder;
  jobs::ChartJob job = chart_of_hung_sheet();
  job.csv = folder / "chart.csv";
  const jobs::ChartReport once = jobs::chart(job, recorder), again = jobs::chart(job, recorder);
  CHECK(once.judgement.has_answer());
  CHECK(to_json(once) == to_json(again));
  CHECK(to_json(once)["scene"] == "hung sheet");
  CHECK(fs::file_size(job.csv) > 100);
  CHECK(recorder.told.back() == std::pair<std::string, double>("trying settings", 1.0));
}

TEST_CASE("chart: a judgement that is cancelled says so and chooses nothing") {
  tests::Recorder whole;
  jobs::chart(chart_of_hung_sheet(), whole);
  tests::Recorder early(4);
  const jobs::ChartReport report = jobs::chart(chart_of_hung_sheet(), early);
  CHECK(report.judgement.broken == jobs::Broken::interrupted);
  CHECK_FALSE(report.judgement.has_answer());
  CHECK(early.asked == 4);
  CHECK(whole.asked > 4);
}

TEST_CASE("chart: a scene for xpbd that names no cloth is of springs, as simulate takes it") {
  tests::Recorder recorder;
  const jobs::ChartReport report =
      jobs::chart(chart_of_hung_sheet("integrator = \"xpbd\"\ndt = 0.002\n"), recorder);
  CHECK(std::ranges::any_of(report.judgement.candidates, [](const jobs::JudgedCandidate& c) {
    return c.candidate.integrator == physics::Integrator::xpbd;
  }));
}

TEST_CASE("chart: options out of their range and pictures of other kinds are refused") {
  tests::Recorder recorder;
  jobs::ChartJob job = chart_of_hung_sheet();
  job.options.tolerance = 0;
  CHECK_THROWS_AS(jobs::chart(job, recorder), std::invalid_argument);
  job = chart_of_hung_sheet();
  job.picture = "chart.jpg";
  CHECK_THROWS_AS(jobs::chart(job, recorder), std::invalid_argument);
}

TEST_CASE("chart: a scene that would settle first is refused with what helps, and charted without") {
  tests::Recorder recorder;
  REQUIRE_THROWS_WITH(jobs::chart(chart_of_hung_sheet("settle = true\n"), recorder),
                      Catch::Contains("simulation.settle=false"));
  CHECK(jobs::chart(chart_of_hung_sheet("settle = false\n"), recorder).judgement.has_answer());
}
