// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <random>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "jobs/base/measure_crossings.h"
#include "jobs/rest/drape.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"
#include "tests/jobs/rest/across_ball.h"

using namespace furrow;
using geometry::TouchKind;
using tests::across_ball;
using tests::set;

namespace {

/// The sheet across the ball at rest, refined twice, and again with touches.
jobs::DrapeJob rested_across_ball() {
  jobs::DrapeJob job = across_ball();
  job.subdivide = 2;
  tests::Recorder quiet;
  io::MeshFile rested = jobs::drape(job, quiet).garments.at(0).file;
  job.subdivide.reset();
  job.scene.memory.meshes["sheet"] = std::move(rested);
  return job;
}

const geometry::Mesh& sheet_of(const jobs::DrapeJob& job) { return job.scene.memory.meshes.at("sheet").mesh; }

/// Of the sheet: on the ball, or where it hangs beside it.
geometry::Point place_of(const jobs::DrapeJob& job, bool hanging) {
  const auto off = [&](const geometry::Point& p) {
    return std::abs(std::hypot(p.x(), p.z()) - (hanging ? 0.13 : 0));
  };
  const auto points = sheet_of(job).points();
  return *std::min_element(points.begin(), points.end(),
                           [&](const auto& p, const auto& q) { return off(p) < off(q); });
}

bool warns_of(const jobs::DrapeJobReport& report, const std::string& code) {
  return std::any_of(report.remarks.begin(), report.remarks.end(),
                     [&](const jobs::DrapeRemark& r) { return r.remark.code == code; });
}

}  // namespace

TEST_CASE(
    "jobs touch: cloth is touched where it rests, what is farther stays to the bit, and a drape keeps it") {
  jobs::DrapeJob job = rested_across_ball();
  const geometry::Mesh before = sheet_of(job);
  for (const TouchKind kind : {TouchKind::iron, TouchKind::steam, TouchKind::pinch, TouchKind::pull}) {
    CAPTURE(geometry::word_of(kind));
    const geometry::Point at = place_of(job, true);
    job.settings.touches = {{kind, at, 0.06, kind == TouchKind::pinch ? 0.3 : 1, {0, 0.01, 0}}};
    tests::Recorder quiet;
    const jobs::Touched touched = jobs::touch(job, quiet);
    REQUIRE(touched.touches.size() == 1);
    const jobs::TouchReport& report = touched.touches[0];
    CHECK(report.balances);
    CHECK(report.vertices > 5);
    CHECK_FALSE(report.remains);
    std::size_t moved = 0;
    for (const geometry::Vertex v : before.vertices()) {
      const bool same = touched.file.mesh->point(v) == before.point(v);
      moved += !same;
      if (CGAL::squared_distance(before.point(v), at) > 2.5 * 2.5 * 0.06 * 0.06) CHECK(same);
    }
    CHECK(moved > 0);
    const jobs::DrapeJobReport rest = jobs::drape(job, quiet);
    const jobs::Draped& draped = rest.garments.at(0);
    CHECK(draped.rests());
    CHECK(draped.crossings.pairs == 0);
    REQUIRE(draped.touches.size() == 1);
    if (draped.touches[0].remains) CHECK(*draped.touches[0].remains > 0.9);
    CHECK_FALSE(warns_of(rest, "touch_fades"));
    const io::Json json = to_json(draped);
    CHECK(json.at("touches").at(0).at("kind") == geometry::word_of(kind));
    CHECK(draped.file.mesh->number_of_vertices() == before.number_of_vertices());
  }
}

TEST_CASE("jobs touch: cloth that is pulled into the body or through other cloth stays out of both") {
  jobs::DrapeJob job = rested_across_ball();
  const geometry::Point hanging = place_of(job, true);
  const geometry::Vector in =
      0.02 / std::hypot(hanging.x(), hanging.z()) * geometry::Vector(-hanging.x(), 0, -hanging.z());
  for (const geometry::Vector& by : {in, geometry::Vector(0, 0.1, 0), 4 * in}) {
    job.settings.touches = {{TouchKind::pull, hanging, 0.06, 1, by}};
    tests::Recorder quiet;
    const jobs::Touched touched = jobs::touch(job, quiet);
    CHECK(jobs::measure_crossings(touched.file).pairs == 0);
    CHECK(touched.crossings == 0);
    if (by != in) continue;
    for (const geometry::Point& p : touched.file.mesh->points())
      CHECK(std::sqrt((p - CGAL::ORIGIN).squared_length()) > 0.1);
  }
}

TEST_CASE("jobs touch: what a touch needs is asked for by name") {
  const auto error = [](jobs::DrapeJob job) -> std::string {
    tests::Recorder quiet;
    try {
      jobs::drape(job, quiet);
    } catch (const std::exception& e) {
      return e.what();
    }
    return "";
  };
  jobs::DrapeJob fresh = across_ball();
  fresh.settings.touches = {{TouchKind::iron, {0, 0.1, 0}, 0.05, 1, {0, 0, 0}}};
  CHECK(error(fresh).find("has no rest state") != std::string::npos);
  jobs::DrapeJob job = rested_across_ball();
  job.settings.touches = {{TouchKind::iron, place_of(job, false), 0.05, 1, {0, 0, 0}},
                          {TouchKind::iron, {1, 1, 1}, 0.05, 1, {0, 0, 0}}};
  CHECK(error(job).find("touch 2: ") != std::string::npos);
  job.settings.touches.resize(1);
  CHECK(error(job) == "");
  job.subdivide = 1;
  CHECK(error(job).find("`subdivide`") != std::string::npos);
  job.subdivide.reset();
  job.settings.touches.clear();
  job.settings.touch_file = "nowhere.json";
  CHECK(error(job).find("nowhere.json") != std::string::npos);
}

TEST_CASE("jobs touch: random touches leave sound cloth that rests, and the same again", "[long]") {
  const jobs::DrapeJob rested = rested_across_ball();
  const auto all = [&] {
    std::mt19937 random(59);
    const auto in = [&](double low, double high) {
      return low + (high - low) * double(random()) / 4294967295.0;
    };
    jobs::DrapeJob job = rested;
    const geometry::Mesh& mesh = sheet_of(job);
    for (int i = 0; i < 40; ++i) {
      const geometry::Vertex v(geometry::Vertex::size_type(random() % mesh.number_of_vertices()));
      const TouchKind kind = TouchKind(random() % 4);
      const double strength = in(0.1, kind == TouchKind::pinch ? 0.3 : 1);
      job.settings.touches.push_back(
          {kind, mesh.point(v), in(0.03, 0.1), strength, {in(-0.01, 0.01), in(0, 0.02), in(-0.01, 0.01)}});
    }
    tests::Recorder quiet;
    std::size_t done = 0;
    for (const geometry::Touch& touch : std::exchange(job.settings.touches, {})) try {
        job.settings.touches = {touch};
        job.scene.memory.meshes["sheet"] = jobs::touch(job, quiet).file;
        ++done;
      } catch (const std::invalid_argument&) {
      }  // the cloth has gone from there
    CHECK(done > 20);
    return job;
  };
  const jobs::DrapeJob job = all(), again = all();
  const geometry::Mesh &mesh = sheet_of(job), &other = sheet_of(again);
  CHECK(std::equal(mesh.points().begin(), mesh.points().end(), other.points().begin()));
  const auto rest = geometry::find_map(mesh, geometry::attribute::rest_length).value();
  for (const geometry::Edge e : mesh.edges()) CHECK(rest[e] > 0);
  jobs::DrapeJob last = job;
  last.settings.touches.clear();
  tests::Recorder quiet;
  const jobs::DrapeJobReport report = jobs::drape(last, quiet);
  CHECK(report.garments.at(0).rests());
  CHECK(report.garments.at(0).crossings.pairs == 0);
}
