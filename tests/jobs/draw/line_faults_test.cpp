// SPDX-License-Identifier: GPL-3.0-or-later
// What is wrong with lines that were drawn, and what is not.
#include <CGAL/Polygon_mesh_processing/orientation.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "geometry/mesh/measures.h"
#include "jobs/chain/wrinkle.h"
#include "tests/jobs/recorder.h"
#include "tests/test_meshes.h"

using namespace furrow;
using geometry::Mesh;
using geometry::Point;

namespace {

io::DrawnStroke stroke(const std::string& name, double height, const std::vector<Point>& points,
                       std::optional<double> width = {}) {
  geometry::Stroke s;
  s.name = name;
  s.height = height;
  s.points.assign(points.begin(), points.end());
  s.width = width;
  return {s};
}

jobs::WrinkleReport draw(Mesh mesh, std::vector<io::DrawnStroke> strokes, tests::Recorder& recorder) {
  io::MeshFile file;
  file.mesh = std::move(mesh);
  jobs::WrinkleJob job;
  job.garment = std::move(file);
  job.strokes = std::move(strokes);
  return jobs::wrinkle(job, recorder);
}

/// A sheet in z = 0 that goes back over itself and on again: three layers, 4 mm apart, between x = 0.2 and
/// 0.28.
Mesh pleated() {
  constexpr double fold = 0.08, gap = 0.004, first = 0.28;
  Mesh mesh = tests::grid(112, 40, 0.56, 0.4);
  for (auto v : mesh.vertices()) {
    const Point p = mesh.point(v);
    const double s = p.x();
    Point to(s, p.y(), 0);
    if (s > first + fold)
      to = {s - 2 * fold, p.y(), 2 * gap};
    else if (s > first)
      to = {2 * first - s, p.y(), gap};
    mesh.point(v) = to;
  }
  return mesh;
}

bool told_beside(const tests::Recorder& recorder) {
  return std::any_of(recorder.warnings.begin(), recorder.warnings.end(), [](const jobs::Warning& w) {
    return w.text.find("side by side") != std::string::npos ||
           w.text.find("runs beside") != std::string::npos;
  });
}

}  // namespace

TEST_CASE(
    "wrinkle: a ridge under a pleat raises its other layers, a valley on top that goes into them fails") {
  tests::Recorder below, above;
  const auto under =
      draw(pleated(), {stroke("under", 0.015, {{0.24, 0.05, -0.001}, {0.24, 0.35, -0.001}})}, below);
  CHECK(under.failures.empty());
  CHECK(under.crossings.pairs == 0);
  CHECK(below.warned_of("drawing"));  // of the layers that went along
  const auto into =
      draw(pleated(), {stroke("into", -0.015, {{0.24, 0.05, 0.009}, {0.24, 0.35, 0.009}})}, above);
  REQUIRE(into.failures.size() == 1);
  CHECK(into.failures[0].code == "layers_cross");
  CHECK(into.failures[0].text.find("(0.2") != std::string::npos);  // where
  CHECK(into.crossings.pairs > 20);
}

TEST_CASE(
    "wrinkle: cloth that gathers on the inner side of a bend is told, and no layer goes through another") {
  tests::Recorder recorder;
  std::vector<Point> bend;
  for (int i = 0; i <= 40; ++i)
    bend.push_back({0.2 + 0.03 * std::cos(0.1 * i), 0.2 + 0.03 * std::sin(0.1 * i), 0});
  const auto report = draw(tests::grid(80, 80, 0.4, 0.4), {stroke("bend", 0.04, bend, 0.1)}, recorder);
  CHECK(report.failures.empty());
}

TEST_CASE(
    "wrinkle: a ridge and a valley that cross do not run side by side, those that do are told by their "
    "crests") {
  const Mesh sheet = tests::grid(40, 40, 0.4, 0.4);
  tests::Recorder across, along;
  draw(sheet,
       {stroke("up", 0.012, {{0.1, 0.2, 0}, {0.3, 0.2, 0}}, 0.12),
        stroke("down", -0.012, {{0.2, 0.1, 0}, {0.2, 0.3, 0}}, 0.12)},
       across);
  CHECK_FALSE(told_beside(across));
  const auto report = draw(sheet,
                           {stroke("up", 0.02, {{0.05, 0.19, 0}, {0.35, 0.19, 0}}, 0.1),
                            stroke("down", -0.02, {{0.05, 0.21, 0}, {0.35, 0.21, 0}}, 0.1)},
                           along);
  CHECK(told_beside(along));
  const auto told = std::find_if(along.warnings.begin(), along.warnings.end(), [](const jobs::Warning& w) {
    return w.text.find("side by side") != std::string::npos;
  });
  REQUIRE(told != along.warnings.end());
  for (const geometry::WrinkledLine& line : report.drawn.round.report.lines) {
    REQUIRE(line.crest_height);
    CHECK(told->text.find(geometry::length_text(*line.crest_height) + " drawn") != std::string::npos);
  }
}

TEST_CASE(
    "wrinkle: lines on a tube that is inside out are told, on one that is not, and on sheets, they are not") {
  const Mesh tube = tests::cylinder(0.2, 0.5, 60, 30);
  Mesh turned = tube;
  CGAL::Polygon_mesh_processing::reverse_face_orientations(turned);
  Mesh bulge = tests::grid(30, 30, 0.4, 0.4);
  tests::lift(bulge, [](double x, double y) { return -0.1 * std::sin(7.85 * x) * std::sin(7.85 * y); });
  const auto down = stroke("front", 0.015, {{0, 0.1, 0.2}, {0, 0.4, 0.2}}, 0.06);
  tests::Recorder right, wrong, sheet;
  draw(tube, {down}, right);
  draw(turned, {down}, wrong);
  draw(bulge, {stroke("a", 0.01, {{0.1, 0.2, -0.06}, {0.3, 0.2, -0.06}}, 0.06)}, sheet);
  CHECK_FALSE(right.warned_of("inside_out"));
  CHECK(wrong.warned_of("inside_out"));
  CHECK_FALSE(sheet.warned_of("inside_out"));
}
