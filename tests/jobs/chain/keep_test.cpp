// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/chain/keep.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "geometry/mesh/sheet.h"
#include "geometry/mesh/struts.h"
#include "io/scene/scene.h"
#include "jobs/chain/wrinkle.h"
#include "physics/base/progress.h"
#include "tests/cli/hung_patch.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"
#include "tests/test_meshes.h"
#include "tests/test_paths.h"

using namespace furrow;
namespace fs = std::filesystem;

namespace {

/// A patch that hangs by an edge, with a ridge in it.
jobs::KeepJob hung_ridge(double height = 0.004) {
  io::DrawnStroke ridge;
  ridge.stroke.name = "ridge";
  ridge.stroke.height = height;
  ridge.stroke.points = {{-0.03, 0.003, 0.02}, {0.03, 0.003, 0.02}};
  jobs::KeepJob job;
  job.scene.memory.meshes["patch"] = io::read_mesh(tests::source_dir() / "meshes/validation/patch.obj");
  job.scene.memory.strokes["ridge"] = {ridge};
  job.scene.settings = io::parse_toml(
      "[garment]\nmesh = \"patch\"\n[[lines]]\nstrokes = \"ridge\"\n" + std::string(tests::hung_patch),
      "test");
  job.seconds = 0.05;
  job.gust = 0;
  return job;
}

/// A level sheet this high above the centre of a ball of 0.12 m, with a ridge to be drawn so far beside
/// its middle [m]. more: lines of the scene's table [material].
jobs::KeepJob sheet_over_ball(double height, double beside = 0.01, const std::string& more = "") {
  io::DrawnStroke ridge;
  ridge.stroke.name = "ridge";
  ridge.stroke.height = 0.004;
  ridge.stroke.width = 0.05;
  ridge.stroke.points = {{-0.06, height, beside}, {0.06, height, beside}};
  jobs::KeepJob job;
  geometry::Mesh& sheet = job.scene.memory.meshes["sheet"].mesh;
  sheet = geometry::equilateral_sheet(0.3, 0.3, 0.015);
  for (const geometry::Vertex v : sheet.vertices())
    sheet.point(v) = {sheet.point(v).x(), height, 0.15 - sheet.point(v).y()};
  job.scene.memory.meshes["ball"].mesh = tests::icosphere(3, 0.12);
  job.scene.memory.strokes["ridge"] = {ridge};
  job.scene.settings = io::parse_toml(
      "[garment]\nmesh = \"sheet\"\n[[lines]]\nstrokes = \"ridge\"\n[body]\nmesh = \"ball\"\n"
      "tolerance = 0.001\n[material]\npreset = \"cotton\"\nfriction = 0.6\n" +
          more,
      "test");
  return job;
}

/// One line of what lies above a ball: the job settles it first unless told not to, and then it is out of
/// balance.
jobs::KeepReport settles_first(jobs::KeepJob& job) {
  job.seconds = 0.02;
  job.gust = 0;
  job.help = false;
  tests::Recorder settling, falling;
  jobs::KeepReport rests = jobs::keep(job, settling);
  CHECK(rests.settled);
  CHECK(settling.warned_of("settled_first"));
  CHECK(rests.lines.rest.imbalance.empty());
  REQUIRE(rests.lines.lines.size() == 1);
  CHECK(rests.lines.lines[0].reason.find("nothing holds the garment") == std::string::npos);
  job.settle = false;
  const jobs::KeepReport falls = jobs::keep(job, falling);
  CHECK_FALSE(falls.settled);
  CHECK_FALSE(falls.lines.rest.imbalance.empty());
  return rests;
}

}  // namespace

TEST_CASE("keep: a sheet above a ball comes to rest on it before its lines are drawn, unless told not to",
          "[long]") {
  jobs::KeepJob job = sheet_over_ball(0.14);
  const jobs::KeepReport rests = settles_first(job);
  double lowest = 1;
  for (const geometry::Point& p : tests::positions(rests.garment)) lowest = std::min(lowest, p.y());
  CHECK(lowest < 0.1);
}

TEST_CASE(
    "keep: a sheet that a few of its vertices balance on a ball comes to rest before its lines are drawn",
    "[long]") {
  jobs::KeepJob job = sheet_over_ball(0.121, 0.09, "rigidity = 1e-4\n");
  job.seconds = 0.02;
  job.gust = 0;
  job.help = false;
  job.settle = false;
  tests::Recorder as_it_lies, settling;
  const jobs::KeepReport level = jobs::keep(job, as_it_lies);
  CHECK(level.lines.rest.imbalance.empty());  // it is balanced
  CHECK(level.lines.rest.touching.size() < 40);
  CHECK_FALSE(level.lines.certificate.stable());
  job.settle = true;
  const jobs::KeepReport rests = jobs::keep(job, settling);
  CHECK(rests.settled);
  CHECK(settling.warned_of("settled_first"));
  CHECK(rests.lines.rest.residual <= 1e-8);
  CHECK(rests.lines.rest.touching.size() > level.lines.rest.touching.size());
  double lowest = 1;
  for (const geometry::Point& p : tests::positions(rests.garment)) lowest = std::min(lowest, p.y());
  CHECK(lowest < 0.1);
}

TEST_CASE("keep: a wrinkled file above a ball comes to rest on it with its lines before it is kept",
          "[release]") {
  jobs::KeepJob job;
  io::MeshFile& file = job.scene.memory.meshes["sheet"];
  {
    jobs::WrinkleJob drawn;
    io::MeshFile sheet;
    sheet.mesh = geometry::equilateral_sheet(0.3, 0.3, 0.015);
    for (const geometry::Vertex v : sheet.mesh->vertices())
      sheet.mesh->point(v) = {sheet.mesh->point(v).x(), 0.14, 0.15 - sheet.mesh->point(v).y()};
    drawn.garment = sheet;
    io::DrawnStroke ridge;
    ridge.stroke.name = "ridge";
    ridge.stroke.height = 0.004;
    ridge.stroke.width = 0.05;
    ridge.stroke.points = {{-0.06, 0.14, 0.01}, {0.06, 0.14, 0.01}};
    drawn.strokes = std::vector{ridge};
    tests::Recorder silent;
    file = jobs::wrinkle(drawn, silent).garment;
  }
  job.scene.memory.meshes["ball"].mesh = tests::icosphere(3, 0.12);
  job.scene.settings = io::parse_toml(
      "[garment]\nmesh = \"sheet\"\n[body]\nmesh = \"ball\"\ntolerance = 0.001\n[material]\n"
      "preset = \"cotton\"\nfriction = 0.6\n",
      "test");
  const jobs::Json line = to_json(settles_first(job)).at("lines").at(0);
  CHECK(line.at("asked").get<double>() == 0.004);
  CHECK(line.at("drawn").get<double>() == Approx(0.004).epsilon(0.03));
  CHECK(line.at("smoothed").get<double>() == Approx(0.004).epsilon(0.05));
}

TEST_CASE("keep: a drawing on a garment too coarse for its gap is made anew on a finer one that rests",
          "[release]") {
  const fs::path folder = tests::empty_folder("keep-coarse");
  io::MeshFile sheet;
  sheet.mesh = geometry::equilateral_sheet(0.3, 0.3, 0.04);
  for (const geometry::Vertex v : sheet.mesh->vertices())
    sheet.mesh->point(v) = {sheet.mesh->point(v).x(), 0.14, 0.15 - sheet.mesh->point(v).y()};
  io::write_mesh(folder / "sheet.obj", sheet);
  io::MeshFile ball;
  ball.mesh = tests::icosphere(3, 0.12);
  io::write_mesh(folder / "ball.obj", ball);
  io::DrawnStroke ridge;
  ridge.stroke.name = "ridge";
  ridge.stroke.height = 0.008;
  ridge.stroke.width = 0.06;
  ridge.stroke.points = {{-0.06, 0.14, 0.01}, {0.06, 0.14, 0.01}};
  jobs::WrinkleJob drawn;
  drawn.garment = folder / "sheet.obj";
  drawn.strokes = std::vector{ridge};
  drawn.options.detail = geometry::Detail::coarse;
  drawn.output = folder / "drawn.ply";
  tests::Recorder silent, refining, leaving;
  const std::size_t coarse = jobs::wrinkle(drawn, silent).garment.mesh->number_of_vertices();
  jobs::KeepJob job;
  job.seconds = 0.02;
  job.gust = 0;
  job.help = false;
  job.scene.folder = folder;
  job.scene.settings = io::parse_toml(
      "[garment]\nmesh = \"drawn.ply\"\n[body]\nmesh = \"ball.obj\"\ntolerance = 0.001\n"
      "[material]\npreset = \"cotton\"\nfriction = 0.6\n",
      "test");
  const jobs::KeepReport finer = jobs::keep(job, refining);
  CHECK(refining.warned_of("refined_first"));
  CHECK(finer.garment.mesh->number_of_vertices() > coarse);
  REQUIRE(finer.record.lines.size() == 1);
  CHECK(finer.record.options.find("--detail coarse") != std::string::npos);
  REQUIRE(finer.lines.lines.size() == 1);
  CHECK(finer.lines.lines[0].lowered > 0.9);  // of what was asked for
  io::set_value(job.scene.settings, "garment.subdivide", 0, "test");
  const jobs::KeepReport as_drawn = jobs::keep(job, leaving);
  CHECK_FALSE(leaving.warned_of("refined_first"));
  CHECK(as_drawn.garment.mesh->number_of_vertices() == coarse);
}

TEST_CASE("keep: a fold that lost half of the height asked before it is kept is lowered, and told so",
          "[release]") {
  jobs::KeepJob job = hung_ridge();
  {
    jobs::WrinkleJob drawn;
    drawn.garment = job.scene.memory.meshes.at("patch");
    drawn.strokes = job.scene.memory.strokes.at("ridge");
    tests::Recorder silent;
    io::MeshFile file = jobs::wrinkle(drawn, silent).garment;
    for (const geometry::Vertex v : file.mesh->vertices()) {  // the patch was level
      const geometry::Point p = file.mesh->point(v);
      file.mesh->point(v) = {p.x(), 0.003 + 0.5 * (p.y() - 0.003), p.z()};
    }
    job.scene.memory.meshes["patch"] = std::move(file);
  }
  job.scene.settings =
      io::parse_toml("[garment]\nmesh = \"patch\"\n" + std::string(tests::hung_patch), "test");
  tests::Recorder recorder;
  const jobs::KeepReport report = jobs::keep(job, recorder);
  const jobs::Json line = to_json(report).at("lines").at(0);
  INFO(line.dump());
  CHECK(line.at("kept").get<double>() == Approx(1).margin(0.05));
  CHECK(line.at("height").get<double>() == Approx(0.002).epsilon(0.05));
  CHECK(line.at("lowered").get<double>() == Approx(0.5).epsilon(0.05));
  CHECK(line.at("verdict") == "lowered");
  CHECK_THAT(line.at("words").get<std::string>(),
             Catch::StartsWith("lowered to h = ") && Catch::Contains(" of 4 mm asked"));
  CHECK_FALSE(report.all_hold());
}

TEST_CASE("keep: words tell the height of what is held at another than asked") {
  io::WrinkleRecord record;
  record.lines = {{"safe", 0.01, 0.01, 0.0067}, {"fold", 0.01, 0.009, 0.009}};
  record.lines[1].crest_height = 0.01;
  bridge::KeptLine smoothed, fold;
  smoothed.line = 0;
  fold.line = 1;
  smoothed.verdict = fold.verdict = bridge::Verdict::pressed;
  smoothed.press = fold.press = 10;
  smoothed.height = 0.0067;
  fold.height = 0.009;
  CHECK(jobs::words(smoothed, record) == "held with press x10 at h = 6.7 mm of 10 mm asked");
  CHECK(jobs::words(fold, record) == "held with press x10");
  fold.height = 0.0108;
  CHECK(jobs::words(fold, record) == "held with press x10 at h = 12 mm of 10 mm asked");
  fold.verdict = bridge::Verdict::lowered;
  fold.height = 0.0045;
  CHECK(jobs::words(fold, record) == "lowered to h = 5 mm of 10 mm asked, with press x10");
}

TEST_CASE("keep: two jobs at once in one process give the bits and the words of single runs", "[long]") {
  tests::Recorder recorder, first, second;
  const jobs::KeepJob low = hung_ridge(), high = hung_ridge(0.006);
  const jobs::KeepReport single_low = jobs::keep(low, recorder), single_high = jobs::keep(high, recorder);
  REQUIRE(single_low.lines.lines.size() == 1);
  CHECK(single_low.all_hold());
  jobs::KeepReport report_low, report_high;
  std::thread beside([&] { report_low = jobs::keep(low, first); });
  report_high = jobs::keep(high, second);
  beside.join();
  CHECK(tests::positions(report_low.garment) == tests::positions(single_low.garment));
  CHECK(tests::positions(report_high.garment) == tests::positions(single_high.garment));
  CHECK(to_json(report_low) == to_json(single_low));
  CHECK(to_json(report_high) == to_json(single_high));
  CHECK(tests::positions(report_low.garment) != tests::positions(report_high.garment));
}

TEST_CASE("keep: cancelled before its first rest state a job writes nothing, later the last one, whole",
          "[long]") {
  const fs::path folder = tests::empty_folder("keep_cancelled");
  jobs::KeepJob job = hung_ridge();
  io::set_value(job.scene.settings, "output.mesh", (folder / "kept.ply").string(), "the test");
  tests::Recorder whole;
  jobs::keep(job, whole);
  fs::remove(folder / "kept.ply");
  std::optional<jobs::KeepReport> report;
  int before = 0, last = whole.asked;  // the latest question that is too early, the first that is not
  while (last - before > 1) {
    const int at = before + (last - before) / 2;
    CAPTURE(at);
    tests::Recorder recorder(at);
    try {
      report = jobs::keep(job, recorder);
      CHECK(recorder.asked <= at + 4);
      last = at;
    } catch (const physics::Cancelled&) {
      CHECK(recorder.asked == at);
      if (!report) CHECK(fs::is_empty(folder));
      before = at;
    }
  }
  CHECK(last > 4);  // within the first rest state, too
  REQUIRE(report);
  CHECK(report->ran);
  CHECK(report->lines.interrupted);
  CHECK(tests::positions(io::read_mesh(folder / "kept.ply")) == tests::positions(report->garment));
  CHECK(std::distance(fs::directory_iterator(folder), fs::directory_iterator()) == 1);
}

TEST_CASE("keep: each trial is told by its number, and goes forwards only", "[release]") {
  jobs::KeepJob job = sheet_over_ball(0.121, 0.09, "rigidity = 1e-6\n");
  job.seconds = 0.02;
  tests::Recorder recorder;
  jobs::keep(job, recorder);
  std::vector<std::string> names;
  double last = 0;
  for (const auto& [what, share] : recorder.told) {
    if (what.rfind("keeping", 0) != 0) continue;
    if (names.empty() || names.back() != what) {
      CHECK(std::find(names.begin(), names.end(), what) == names.end());
      names.push_back(what);
      last = 0;
    }
    CHECK(share >= last);
    last = share;
  }
  REQUIRE(names.size() > 1);
  CHECK(names[0] == "keeping, trial 1");
  CHECK(names[1] == "keeping, trial 2, more help for 1 line");
}

TEST_CASE("keep: help that excludes help is refused") {
  jobs::KeepJob job = hung_ridge();
  job.whole = true;
  job.help = false;
  tests::Recorder recorder;
  CHECK_THROWS_AS(jobs::keep(job, recorder), std::invalid_argument);
}

TEST_CASE("keep: a thread that has yet to draw its line in is no shape to keep, and is named") {
  jobs::KeepJob job = hung_ridge();
  auto& stroke = job.scene.memory.strokes["ridge"].front().stroke;
  stroke.height = 0;
  stroke.gather = 0.8;
  tests::Recorder recorder;
  CHECK_THROWS_WITH(jobs::keep(job, recorder),
                    Catch::Contains("'ridge'") && Catch::Contains("`furrow drape`"));
  stroke.gather = 1;  // it is as long as it is
  const jobs::KeepReport kept = jobs::keep(job, recorder);
  CHECK(kept.lines.lines.empty());
  CHECK(geometry::struts(kept.garment.mesh).size() > 2);
}
