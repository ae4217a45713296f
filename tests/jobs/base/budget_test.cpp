// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/base/budget.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <ctime>
#include <limits>
#include <nlohmann/json.hpp>

#include "geometry/mesh/sheet.h"
#include "jobs/chain/keep.h"
#include "jobs/chain/wrinkle.h"
#include "jobs/rest/drape.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"
#include "tests/test_meshes.h"

using namespace furrow;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

constexpr double no_end = std::numeric_limits<double>::infinity();

/// A sheet that falls over a ball, refined so often that it takes a while.
jobs::DrapeJob over_ball() {
  jobs::DrapeJob job;
  geometry::Mesh& sheet = job.scene.memory.meshes["sheet"].mesh;
  sheet = geometry::equilateral_sheet(0.3, 0.3, 0.03);
  for (const geometry::Vertex v : sheet.vertices())
    sheet.point(v) = {sheet.point(v).x(), 0.105, sheet.point(v).y() - 0.15};
  job.scene.memory.meshes["ball"].mesh = tests::icosphere(2, 0.1);
  job.scene.settings = io::parse_toml(
      "[garment]\nmesh = \"sheet\"\n[body]\nmesh = \"ball\"\ntolerance = 0.005\n"
      "[material]\npreset = \"cotton\"\n",
      "test");
  job.subdivide = 2;
  return job;
}

/// A ridge on it, which comes to rest.
jobs::WrinkleJob ridge_over_ball() {
  jobs::WrinkleJob job;
  job.settle = over_ball().scene;
  job.garment = job.settle->memory.meshes["sheet"];
  io::DrawnStroke ridge;
  ridge.stroke.name = "ridge";
  ridge.stroke.height = 0.01;
  ridge.stroke.points = {{-0.05, 0.105, 0}, {0.05, 0.105, 0}};
  job.strokes = std::vector{ridge};
  return job;
}

/// Takes processor time as soon as the balance of what is drawn begins.
class SlowBalance : public tests::Recorder {
 public:
  explicit SlowBalance(double seconds) : seconds_(seconds) {}
  void progress(const std::string& what, double share) override {
    Recorder::progress(what, share);
    if (what != "balancing what is drawn" || share > 0) return;
    for (const std::clock_t begin = std::clock(); double(std::clock() - begin) < seconds_ * CLOCKS_PER_SEC;) {
    }
  }

 private:
  double seconds_;
};

}  // namespace

TEST_CASE("budget: what the other listener says is passed on, and a spent budget stays spent") {
  tests::Recorder recorder(3);
  jobs::Budget endless("test", no_end, recorder), spent("test", 1e-9, recorder);
  CHECK_FALSE(endless.cancelled());
  CHECK(spent.cancelled());
  CHECK(spent.is_spent());
  CHECK(endless.cancelled());  // the other one did
  CHECK_FALSE(endless.is_spent());
  endless.warn({"code", "text", "", ""});
  endless.progress("work", 0.5);
  CHECK(recorder.warned_of("code"));
  CHECK(recorder.told.back().first == "work");
  for (const double wrong : {0.0, -1.0, std::nan("")})
    CHECK_THROWS_AS(jobs::Budget("test", wrong, recorder), std::invalid_argument);
}

TEST_CASE("budget: a job that ends within it has the same bits as one without") {
  jobs::DrapeJob job = over_ball();
  job.subdivide = 0;
  tests::Recorder recorder;
  const jobs::DrapeJobReport within = jobs::drape(job, recorder);
  job.budget = no_end;
  const jobs::DrapeJobReport without = jobs::drape(job, recorder);
  CHECK_FALSE(within.budget_spent);
  CHECK(tests::positions(within.garments[0].file) == tests::positions(without.garments[0].file));
}

TEST_CASE("budget: whatever it is, a drape ends with a garment that is written and measured, or a sentence",
          "[release]") {
  const fs::path folder = tests::empty_folder("budget");
  jobs::DrapeJob job = over_ball();
  job.output = folder / "worn.ply";
  int sentences = 0, cut = 0;
  bool whole = false;
  for (job.budget = 0.01; !whole && job.budget < 200; job.budget *= 1.3) {
    tests::Recorder recorder;
    fs::remove(job.output);
    try {
      const jobs::DrapeJobReport report = jobs::drape(job, recorder);
      whole = !report.budget_spent;
      cut += report.budget_spent;
      CHECK(fs::exists(job.output));
      CHECK(report.cancelled() == report.budget_spent);
      CHECK(to_json(report).contains("budget_spent") == report.budget_spent);
      CHECK(std::isfinite(report.garments[0].fit.distance.deepest_penetration));
    } catch (const jobs::BudgetSpent& e) {
      ++sentences;
      CHECK_THAT(e.what(), Contains("was spent before there was anything to write"));
      CHECK(tests::names_in(folder).empty());
    }
  }
  CHECK(whole);
  CHECK(sentences > 0);
  CHECK(cut > 0);
}

TEST_CASE("budget: once there is a state, whenever a drape is cancelled, it returns what was reached",
          "[release]") {
  jobs::DrapeJob job = over_ball();
  job.subdivide = 1;
  geometry::Mesh& garment = job.scene.memory.meshes["sheet"].mesh;
  const auto corner = [&](double x, double z) { return garment.add_vertex({x, 0.125, z}); };
  garment.add_face(corner(0.2, 0), corner(0.2, 0.01), corner(0.21, 0));  // a button beside it, which falls
  int returned = 0, thrown_later = 0;
  bool whole = false;
  for (int at = 1; !whole; at += 1 + at / 25) {
    tests::Recorder recorder(at);
    try {
      whole = !jobs::drape(job, recorder).cancelled();
      ++returned;
    } catch (const physics::Cancelled&) {
      thrown_later += returned > 0;
    }
  }
  CHECK(returned > 5);
  CHECK(thrown_later == 0);
}

TEST_CASE("budget: a keep without time for its first rest state says so") {
  jobs::KeepJob job;
  job.scene = over_ball().scene;
  job.budget = 1e-6;
  tests::Recorder recorder;
  CHECK_THROWS_AS(jobs::keep(job, recorder), jobs::BudgetSpent);
}

TEST_CASE("budget: where to balance what is drawn takes over half of it, lines fall, and that is said",
          "[release]") {
  jobs::WrinkleJob job = ridge_over_ball();
  job.budget = 8;
  tests::Recorder quick;
  CHECK(jobs::wrinkle(job, quick).rest);
  CHECK_FALSE(quick.warned_of("lines_not_held"));
  SlowBalance slow(4.2);
  const jobs::WrinkleReport report = jobs::wrinkle(job, slow);
  CHECK(slow.warned_of("lines_not_held"));
  REQUIRE(report.rest);
  CHECK(report.rest->report.levels.back().settle.converged);
  CHECK_FALSE(report.budget_spent);
}

TEST_CASE("budget: of lines that come to rest, drawing is a part") {
  const fs::path folder = tests::empty_folder("budget_drawn");
  jobs::WrinkleJob job = ridge_over_ball();
  job.smoothed = folder / "drawn.ply";
  job.budget = 1e-6;
  tests::Recorder recorder;
  CHECK_THROWS_AS(jobs::wrinkle(job, recorder), jobs::BudgetSpent);
  CHECK_FALSE(fs::exists(job.smoothed));
}
