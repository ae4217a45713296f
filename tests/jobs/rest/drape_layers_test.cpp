// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "geometry/mesh/sheet.h"
#include "io/scene/scene.h"
#include "jobs/rest/drape.h"
#include "jobs/rest/drape_plan.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"
#include "tests/test_meshes.h"
#include "tests/test_paths.h"

using namespace furrow;
namespace fs = std::filesystem;

namespace {

io::MeshFile sheet_at(double height, double edge, double tilt) {
  io::MeshFile file;
  file.mesh = geometry::equilateral_sheet(0.3, 0.3, edge);
  for (const geometry::Vertex v : file.mesh->vertices()) {
    const geometry::Point p = file.mesh->point(v);
    file.mesh->point(v) = {p.x(), height + tilt * p.x(), 0.15 - p.y()};
  }
  return file;
}

/// Two squares of cloth that cross each other above a ball, in memory.
jobs::DrapeJob two_across_ball(double tilt = 0.03) {
  jobs::DrapeJob job;
  job.scene.memory.meshes["under"] = sheet_at(0.108, 0.05, 0);
  job.scene.memory.meshes["over"] = sheet_at(0.108, 0.043, tilt);
  job.scene.memory.meshes["ball"].mesh = tests::icosphere(2, 0.1);
  job.scene.settings = io::parse_toml("[garment]\nmesh = \"under\"\n", "test");
  const auto set = [&](const char* path, const io::Json& value) {
    io::set_value(job.scene.settings, path, value, "the test");
  };
  set("body.mesh", "ball");
  set("body.tolerance", 0.005);
  set("material.preset", "cotton");
  job.over = {"over"};
  job.subdivide = 0;
  return job;
}

bool tells(const jobs::DrapeJobReport& report, const std::string& code) {
  return std::any_of(report.remarks.begin(), report.remarks.end(),
                     [&](const jobs::DrapeRemark& r) { return r.remark.code == code; });
}

void check_refused(const jobs::DrapeJob& job, const std::string& words) {
  tests::Recorder recorder;
  try {
    jobs::drape(job, recorder);
    FAIL("nothing was refused; expected: " << words);
  } catch (const std::invalid_argument& e) {
    INFO(e.what());
    CHECK(std::string(e.what()).find(words) != std::string::npos);
  }
}

}  // namespace

TEST_CASE("drape: layers that cross come apart in their order, and each is written", "[release]") {
  const fs::path folder = tests::empty_folder("drape_layers");
  tests::Recorder recorder;
  jobs::DrapeJob job = two_across_ball();
  job.output = folder / "worn.ply";
  const jobs::DrapeJobReport report = jobs::drape(job, recorder);
  INFO(to_json(report).dump(1));
  REQUIRE(report.garments.size() == 2);
  REQUIRE(report.layers);
  REQUIRE(report.layers->pairs.size() == 1);
  const jobs::LayerPair& pair = report.layers->pairs[0];
  CHECK(pair.inner == "under");
  CHECK(pair.outer == "over");
  CHECK(pair.crossings_at_start > 0);
  CHECK(pair.crossings == 0);
  CHECK(pair.compared > 10);
  const bool under = 2 * pair.outside < pair.compared;  // so wide a sheet hangs off the ball on either side
  CHECK(tells(report, "layer_under") == under);
  CHECK(report.fails() == under);
  CHECK(tests::names_in(folder) == std::set<std::string>{"worn-under.ply", "worn-over.ply"});
  CHECK(tests::positions(io::read_mesh(folder / "worn-over.ply")) ==
        tests::positions(report.garments[1].file));
  io::set_value(job.scene.settings, "simulation.threads", 2, "the test");
  job.output.clear();
  const jobs::DrapeJobReport again = jobs::drape(job, recorder);
  for (std::size_t i = 0; i < 2; ++i)
    CHECK(tests::positions(again.garments[i].file) == tests::positions(report.garments[i].file));
}

TEST_CASE("drape: coincident layers and a garment turned inside out are solved, and told", "[release]") {
  tests::Recorder recorder;
  jobs::DrapeJob job = two_across_ball();
  job.scene.memory.meshes["over"] = job.scene.memory.meshes["under"];
  CHECK(jobs::drape(job, recorder).layers->pairs[0].crossings == 0);
  for (geometry::Point& p : job.scene.memory.meshes["under"].mesh->points()) p = {-p.x(), p.y(), p.z()};
  const jobs::DrapeJobReport turned = jobs::drape(job, recorder);
  CHECK(tells(turned, "turned"));
  CHECK(turned.layers->turned == std::vector<std::string>{"under"});
  CHECK(turned.layers->pairs[0].crossings == 0);
}

TEST_CASE("drape: a skirt over leggings comes to rest where steps are cut short at first", "[release]") {
  if (!tests::have_shared()) {
    WARN("skipped: no shared data");
    return;
  }
  const fs::path pair = tests::shared_dir() / "meshes/pairs/mh_female";
  tests::Recorder recorder;
  jobs::DrapeJob job;
  job.scene.settings = io::parse_toml("[garment]\nmesh = \"x\"\n", "test");
  io::set_value(job.scene.settings, "garment.mesh", (pair / "leggings.obj").string(), "the test");
  io::set_value(job.scene.settings, "body.mesh", (pair / "body.obj").string(), "the test");
  job.over = {pair / "skirt.obj"};
  job.subdivide = 0;
  const jobs::DrapeJobReport report = jobs::drape(job, recorder);
  const physics::SettleReport& rest = report.garments.at(1).report.levels.back().settle;
  INFO("ended after " << rest.iterations << " iterations, residual " << rest.residual);
  CHECK_FALSE(rest.self.blocked);  // with factors of before the cuts, after one iteration
  CHECK(rest.self.cut_searches > 1);
  CHECK_FALSE(report.fails());
  CHECK(report.layers->pairs.at(0).crossings == 0);
}

TEST_CASE("drape: a garment that lies inside the one under it is refused with what to swap, unless forced",
          "[release]") {
  jobs::DrapeJob job = two_across_ball(0);
  job.scene.memory.meshes["under"] = sheet_at(0.118, 0.05, 0);
  check_refused(job, "over before under");
  struct : tests::Recorder {
    bool allows(const std::string&) override { return true; }
  } recorder;
  const jobs::DrapeJobReport report = jobs::drape(job, recorder);
  INFO(to_json(report).dump(1));
  CHECK(report.layers->pairs[0].began_inside());
  CHECK((tells(report, "layer_order") || tells(report, "layers_cross")));
}

TEST_CASE("drape: a garment that touches no other passes through it, which is told and no failure",
          "[long]") {
  tests::Recorder recorder;
  jobs::DrapeJob job = two_across_ball();
  job.over.clear();
  io::Json list = io::Json::array({{{"mesh", "under"}}, {{"mesh", "over"}, {"touch", false}}});
  job.scene.settings.root["garment"] = list;
  const jobs::DrapeJobReport report = jobs::drape(job, recorder);
  INFO(to_json(report).dump(1));
  CHECK_FALSE(report.fails());
  const jobs::LayerPair& pair = report.layers->pairs.at(0);
  CHECK_FALSE(pair.touch);
  CHECK(pair.crossings > 0);
  CHECK(report.layers->edges_crossed == 0);
  CHECK(tells(report, "layers_apart"));
  CHECK_FALSE(tells(report, "layers_cross"));
  CHECK(to_json(report)["layers"]["pairs"][0]["touch"] == false);
  for (const jobs::Draped& d : report.garments) CHECK(d.crossings_with_others == 0);
  list[1].erase("touch");
  job.scene.settings.root["garment"] = list;
  const jobs::DrapeJobReport touching = jobs::drape(job, recorder);
  CHECK(touching.layers->pairs[0].crossings == 0);
}

TEST_CASE("drape: what several garments are not draped with is refused") {
  jobs::DrapeJob job = two_across_ball();
  job.over = {"under"};
  check_refused(job, "given twice");
  job = two_across_ball();
  job.settings.self_contact = jobs::SelfContactUse::off;
  check_refused(job, "`self_contact=off`");
  job = two_across_ball();
  job.settings.loose = jobs::LooseUse::drop;
  check_refused(job, "`loose=drop`: not with several garments");
  job = two_across_ball();
  job.settings.plain = true;
  check_refused(job, "`plain`: not with several garments");
  job = two_across_ball();
  job.settings.bands = {{"top", 0.9}};
  check_refused(job, "`band`: not with several garments");
  job = two_across_ball();
  job.output = "-";
  check_refused(job, "several files");
  job = two_across_ball();
  job.scene.settings.root->erase("body");
  io::set_value(job.scene.settings, "pins.0", io::Json{{"vertices", {0}}}, "the test");
  check_refused(job, "pins");
}

TEST_CASE("drape: layers that their user cancels end on the level that they have come to", "[long]") {
  const fs::path folder = tests::empty_folder("drape_layers_cancelled");
  jobs::DrapeJob job = two_across_ball();
  job.subdivide = 1;
  job.output = folder / "worn.ply";
  tests::AfterField all;
  jobs::drape(job, all);
  std::set<std::size_t> ends;
  for (int k = 1; k < 25; ++k) {
    tests::AfterField listener(all.asked * k / 25);
    try {
      const jobs::DrapeJobReport report = jobs::drape(job, listener);
      std::size_t vertices = 0;
      for (const jobs::Draped& d : report.garments) {
        CHECK(d.outcome() == "interrupted");
        CHECK(tests::positions(io::read_mesh(d.written)) == tests::positions(d.file));
        vertices += d.file.mesh->number_of_vertices();
      }
      const auto& levels = report.garments.at(0).report.levels;
      CHECK(vertices == levels.back().vertices);
      ends.insert(levels.size());
    } catch (const physics::Cancelled&) {
      ends.insert(0);
    }
  }
  CHECK(ends.count(1) == 1);
  CHECK(ends.count(2) == 1);
}

TEST_CASE("layer_output: a garment's name goes where braces stand, else before the ending") {
  CHECK(jobs::layer_output("a/{}.ply", "shirt") == "a/shirt.ply");
  CHECK(jobs::layer_output("a/worn.ply", "shirt") == "a/worn-shirt.ply");
  CHECK(jobs::layer_output("x-{}-y.obj", "vest") == "x-vest-y.obj");
}

TEST_CASE(
    "way_to_rest: it grows from 0 to 1 with the residual's logarithm, and no force without end spoils it") {
  jobs::WayToRest way(1e-3);
  physics::SettleProgress p{};
  const auto at = [&](double residual) {
    p.residual = residual;
    return way.share(p);
  };
  CHECK(at(std::numeric_limits<double>::infinity()) == 0);
  CHECK(at(1) == 0);
  CHECK(at(0.1) == Approx(1.0 / 3));
  CHECK(at(0.01) == Approx(2.0 / 3));
  CHECK(at(1e-3) == 1);
  CHECK(at(0) == 1);
  CHECK(at(10) == 0);
  CHECK(at(std::numeric_limits<double>::quiet_NaN()) == 0);
  CHECK(at(0.1) == Approx(0.5));
}
