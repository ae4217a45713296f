// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "geometry/mesh/sheet.h"
#include "io/scene/scene.h"
#include "jobs/rest/drape.h"
#include "tests/jobs/recorder.h"
#include "tests/test_meshes.h"

using namespace furrow;

namespace {

void put(jobs::DrapeJob& job, const std::string& path, const io::Json& value) {
  io::set_value(job.scene.settings, path, value, "the test");
}

void add_sheet(geometry::Mesh& to, const geometry::Mesh& sheet) {
  std::vector<geometry::Vertex> copies;
  for (const geometry::Vertex v : sheet.vertices()) copies.push_back(to.add_vertex(sheet.point(v)));
  for (const geometry::Face f : sheet.faces()) {
    std::vector<geometry::Vertex> corners;
    for (const geometry::Vertex v : sheet.vertices_around_face(sheet.halfedge(f)))
      corners.push_back(copies[v.idx()]);
    to.add_face(corners);
  }
}

/// Two squares of cloth in one file, across a ball of 10 cm and held at one side; the second where `place`
/// says.
template <class Place>
jobs::DrapeJob two_in_a_file(double edge, const Place& place) {
  jobs::DrapeJob job;
  geometry::Mesh &both = job.scene.memory.meshes["both"].mesh,
                 upper = geometry::equilateral_sheet(0.3, 0.3, edge);
  geometry::Mesh lower = upper;
  for (const geometry::Vertex v : lower.vertices()) {
    const geometry::Point p = lower.point(v);
    const double x = p.x(), z = p.y() - 0.15;
    lower.point(v) = {x, 0.105, z};
    upper.point(v) = place(x + 0.0031, z + 0.0017);
  }
  add_sheet(both, lower);
  add_sheet(both, upper);
  job.scene.memory.meshes["ball"].mesh = tests::icosphere(2, 0.1);
  job.scene.settings = io::parse_toml("[garment]\nmesh = \"both\"\n", "test");
  put(job, "body.mesh", "ball");
  put(job, "body.tolerance", 0.005);
  put(job, "pins.0", io::Json{{"box", {-1, 0, -1, -0.13, 1, 1}}});
  job.subdivide = 0;
  return job;
}

bool says(const jobs::DrapeJobReport& report, const std::string& words) {
  return std::any_of(report.remarks.begin(), report.remarks.end(), [&](const jobs::DrapeRemark& r) {
    return r.remark.text.find(words) != std::string::npos;
  });
}

}  // namespace

TEST_CASE("drape: a file that crosses itself is taken apart before it comes to rest", "[long]") {
  tests::Recorder recorder;
  jobs::DrapeJob job = two_in_a_file(0.025, [](double x, double z) {
    return geometry::Point(x, 0.108 - 0.008 * std::exp(-(x * x + z * z) / 0.003), z);
  });
  for (const auto use : {jobs::SelfContactUse::on, jobs::SelfContactUse::automatic}) {
    job.settings.self_contact = use;
    const jobs::DrapeJobReport report = jobs::drape(job, recorder);
    const jobs::Draped& d = report.garments.at(0);
    const io::Json told = to_json(report);
    INFO(told.dump(1));
    CHECK(d.crossings.at_start.value() > 10);
    CHECK(d.self_contact);
    CHECK(d.untangled.at_start > 10);
    CHECK(d.untangled.left == 0);
    CHECK(d.crossings.pairs == 0);
    CHECK(d.rests());
    CHECK(told.at("untangled").at("left") == 0);
    CHECK(told["untangled"].at("moved_most").get<double>() > 0);
    CHECK(told["untangled"].at("lines").empty());
  }
  job.settings.self_contact = jobs::SelfContactUse::off;
  const jobs::DrapeJobReport off = jobs::drape(job, recorder);
  CHECK_FALSE(to_json(off).contains("untangled"));
}

TEST_CASE("drape: what cannot be taken apart is told, with its place and length, and pieces as files",
          "[long]") {
  tests::Recorder recorder;
  jobs::DrapeJob job =
      two_in_a_file(0.015, [](double x, double z) { return geometry::Point(x, 0.105 + z, 0.3 * z); });
  job.settings.self_contact = jobs::SelfContactUse::on;
  job.settings.iterations = 3;
  const jobs::DrapeJobReport report = jobs::drape(job, recorder);
  const jobs::Draped& d = report.garments.at(0);
  INFO(to_json(report).dump(1));
  CHECK(d.untangled.left > 0);
  CHECK(d.untangled.left <= d.untangled.at_start);
  REQUIRE(!d.untangled.lines.empty());
  CHECK(to_json(report)["untangled"]["lines"][0]["length"].get<double>() > 0.05);
  CHECK(d.crosses_itself());
  CHECK(says(report, "could not be taken apart"));
  CHECK(says(report, "give each as a file of its own"));
}
