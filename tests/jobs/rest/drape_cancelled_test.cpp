// SPDX-License-Identifier: GPL-3.0-or-later
// What a drape leaves that its user cancels.
#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "jobs/rest/drape.h"
#include "physics/base/progress.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"
#include "tests/jobs/rest/across_ball.h"
#include "tests/test_paths.h"

using namespace furrow;
using tests::across_ball;
using tests::set;
namespace fs = std::filesystem;

namespace {

/// Cancels once draping was told so many times.
class EndsDraping : public tests::Recorder {
 public:
  explicit EndsDraping(int at) : at_(at) {}
  void progress(const std::string& what, double) override { draped_ += what == "draping"; }
  bool cancelled() override { return draped_ >= at_; }

 private:
  int at_, draped_ = 0;
};

}  // namespace

TEST_CASE("drape: a job that is cancelled before anything was found leaves nothing") {
  const fs::path folder = tests::empty_folder("drape_cancelled_early");
  jobs::DrapeJob job = across_ball();
  job.output = folder / "worn.ply";
  job.settings.animation = folder / "way.pc2";
  tests::Recorder recorder(1);
  CHECK_THROWS_AS(jobs::drape(job, recorder), physics::Cancelled);
  CHECK(tests::names_in(folder).empty());
}

TEST_CASE("drape: what a cancelled job reached is reported, and written whole", "[long]") {
  const fs::path folder = tests::empty_folder("drape_cancelled");
  jobs::DrapeJob job = across_ball();
  job.output = folder / "worn.ply";
  job.settings.animation = folder / "way.pc2";
  const std::size_t iterations = [&] {
    tests::Recorder all;
    jobs::drape(job, all);
    return std::count_if(all.told.begin(), all.told.end(),
                         [](const auto& t) { return t.first == "draping"; });
  }();
  REQUIRE(iterations > 6);
  for (int at : {1, 3, 6}) {
    for (const fs::path& file : {job.output, job.settings.animation}) fs::remove(file);
    EndsDraping listener(at);
    const jobs::DrapeJobReport report = jobs::drape(job, listener);
    CHECK(report.cancelled());
    CHECK(report.fails());
    CHECK(report.remarks.empty());
    CHECK(report.garments.at(0).outcome() == "interrupted");
    CHECK(tests::positions(io::read_mesh(job.output)) == tests::positions(report.garments[0].file));
    std::set<std::string> files{"worn.ply"};
    if (report.garments[0].animated) files.insert("way.pc2");
    CHECK(tests::names_in(folder) == files);
  }
}

TEST_CASE("drape: cancelled by its user at any question, a garment ends on the level that it has come to",
          "[long]") {
  const fs::path folder = tests::empty_folder("drape_cancelled_on_its_way_up");
  jobs::DrapeJob job = across_ball();
  job.subdivide = 2;
  job.settings.bands = {{"0", 0.9}};
  job.output = folder / "worn.ply";
  tests::AfterField all;
  jobs::drape(job, all);
  std::set<std::size_t> ends;
  for (int k = 1; k < 40; ++k) {
    fs::remove(job.output);
    tests::AfterField listener(all.asked * k / 40);
    const jobs::DrapeJobReport report = jobs::drape(job, listener);
    const jobs::Draped& d = report.garments.at(0);
    CHECK(d.outcome() == "interrupted");
    CHECK(d.file.mesh->number_of_vertices() == d.report.levels.back().vertices);
    CHECK(to_json(report).contains("fit") == d.measured);
    CHECK(tests::positions(io::read_mesh(job.output)) == tests::positions(d.file));
    ends.insert(d.report.levels.size());
  }
  CHECK(ends == std::set<std::size_t>{1, 2, 3});         // the first is there at once
  for (int at = all.asked - 8; at <= all.asked; ++at) {  // about the end, where it is measured
    tests::AfterField listener(at);
    const jobs::Draped d = jobs::drape(job, listener).garments.at(0);
    CHECK((d.measured || d.outcome() == "interrupted"));
    CHECK(to_json(d).contains("fit") == d.measured);
  }
}

TEST_CASE("drape: cancelled after the first of several starts, what rests is written and told as interrupted",
          "[long]") {
  const fs::path folder = tests::empty_folder("drape_starts_cancelled");
  jobs::DrapeJob job = across_ball();
  tests::Recorder all;
  const jobs::Draped single = jobs::drape(job, all).garments.at(0);
  const auto told =
      std::count_if(all.told.begin(), all.told.end(), [](const auto& t) { return t.first == "draping"; });
  set(job, "simulation.starts", 4);
  job.output = folder / "worn.ply";
  EndsDraping listener(int(told) + 3);
  const jobs::DrapeJobReport report = jobs::drape(job, listener);
  CHECK(report.cancelled());
  REQUIRE(report.garments.at(0).starts);
  CHECK(report.garments[0].starts->runs.size() == 1);
  CHECK(report.garments[0].outcome() == "interrupted");
  CHECK(tests::positions(io::read_mesh(job.output)) == tests::positions(single.file));
}
