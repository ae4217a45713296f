// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/stroke/prepare_strokes.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/sheet.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

constexpr double edge = 0.02;

Stroke line(const std::vector<Point>& points, double height = 0.01) {
  Stroke stroke;
  stroke.name = "fold";
  stroke.height = height;
  stroke.points.assign(points.begin(), points.end());
  return stroke;
}

PreparedStrokes prepare(const Mesh& mesh, std::vector<Stroke> strokes) {
  return prepare_strokes(mesh, strokes, {0.05, edge, 0});
}

bool warns(const PreparedStrokes& prepared, const std::string& of) {
  return std::any_of(prepared.warnings.begin(), prepared.warnings.end(),
                     [&](const std::string& w) { return w.find(of) != std::string::npos; });
}

/// |x| <= 0.3, 0 <= y <= 0.4.
Mesh sheet() { return equilateral_sheet(0.6, 0.4, edge); }

}  // namespace

TEST_CASE("prepare_strokes: a straight line stays straight and its points are evenly spaced on the mesh") {
  const Mesh mesh = sheet();
  const FoldCurve curve = prepare(mesh, {line({{-0.2, 0.1, 0}, {0.2, 0.31, 0}})}).curves.at(0);
  CHECK(curve.length == Approx(std::hypot(0.4, 0.21)).epsilon(1e-9));
  const Eigen::Vector3d a(-0.2, 0.1, 0), along = Eigen::Vector3d(0.4, 0.21, 0).normalized();
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const Eigen::Vector3d d = curve.points[i] - a;
    CHECK((d - d.dot(along) * along).norm() < 1e-12);
    CHECK(d.dot(along) == Approx(curve.arc[i]).margin(1e-12));
    const Point on = position_of(mesh, curve.places[i]);
    CHECK((Eigen::Vector3d(on.x(), on.y(), on.z()) - curve.points[i]).norm() < 1e-12);
  }
  CHECK_FALSE((curve.begins_at_border || curve.ends_at_border));
}

TEST_CASE("prepare_strokes: a hand's jitter goes, the ends stay, and a line moved far is told") {
  const Mesh mesh = sheet();
  std::mt19937 random(7);
  std::normal_distribution<double> jitter(0, 0.0005);
  std::vector<Point> points;
  for (int i = 0; i <= 100; ++i) points.emplace_back(-0.2 + 0.004 * i, 0.2 + jitter(random), 0);
  Stroke stroke = line(points);
  stroke.width = 0.1;
  const PreparedStrokes prepared = prepare(mesh, {stroke});
  double squares = 0;
  const FoldCurve& curve = prepared.curves.at(0);
  for (const auto& p : curve.points) squares += (p.y() - 0.2) * (p.y() - 0.2);
  CHECK(std::sqrt(squares / static_cast<double>(curve.points.size())) < 0.00035);
  CHECK(curve.points.front().y() == Approx(points.front().y()).margin(1e-12));
  CHECK_FALSE(warns(prepared, "smoothing moves it"));
  stroke.smooth = 0;
  const auto raw = prepare(mesh, {stroke}).curves.at(0);
  CHECK(raw.length > curve.length);
  Stroke bent = line({{-0.2, 0.1, 0}, {0, 0.35, 0}, {0.2, 0.1, 0}});
  bent.width = 0.15;
  bent.smooth = 3;
  CHECK(warns(prepare(mesh, {bent}), "smoothing moves it"));
}

TEST_CASE(
    "prepare_strokes: a line without a width gets five heights, its neighbour's distance, or four edges, "
    "which are "
    "no more than seven and a half heights") {
  const Mesh mesh = sheet();
  const auto width = [&](const std::vector<Stroke>& strokes) {
    return prepare(mesh, strokes).curves[0].width[0];
  };
  const Stroke up = line({{0, 0.05, 0}, {0, 0.35, 0}}, 0.03);
  CHECK(width({up}) == Approx(0.15));
  CHECK(width({line({{0, 0.05, 0}, {0, 0.35, 0}}, -0.6 * edge)}) == Approx(4 * edge));
  CHECK(width({line({{0, 0.05, 0}, {0, 0.35, 0}}, -0.1 * edge)}) == Approx(0.75 * edge));
  CHECK(width({line({{0, 0.05, 0}, {0, 0.35, 0}}, 0)}) == Approx(4 * edge));
  CHECK(width({up, line({{0.11, 0, 0}, {0.11, 0.4, 0}}, 0.02)}) == Approx(0.11).epsilon(1e-4));
  CHECK(width({up, line({{0.11, 0, 0}, {0.11, 0.4, 0}}, -0.02)}) == Approx(0.15));  // a valley
  CHECK(width({up, line({{0.05, 0.1, 0}, {0.3, 0.1, 0}}, 0.02)}) == Approx(0.15));  // it runs across
  CHECK(warns(prepare(mesh, {[&] {
                        Stroke steep = up;
                        steep.width = 0.09;
                        return steep;
                      }()}),
              "steeper than 45 degrees"));
}

TEST_CASE("prepare_strokes: lines that are too steep are told in one warning, the steepest by name") {
  std::vector<Stroke> strokes;
  for (int i = 0; i < 3; ++i) {
    strokes.push_back(line({{-0.1 + 0.1 * i, 0.05, 0}, {-0.1 + 0.1 * i, 0.35, 0}}, 0.03 + 0.01 * i));
    strokes.back().name = "line " + std::to_string(i);
    strokes.back().width = 0.08;
  }
  const std::vector<std::string> warnings = prepare(sheet(), strokes).warnings;
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0] ==
        "stroke \"line 2\": its height is 0.62 of its width (and 2 others): steeper than 45 degrees, "
        "from 0.31 on; a wider or lower line is smoother");
}

TEST_CASE("prepare_strokes: ends at a hem are at the border, and one such end makes a flare") {
  const Mesh mesh = sheet();
  const auto curve = [&](Point a, Point b) { return prepare(mesh, {line({a, b})}).curves.at(0); };
  const FoldCurve over = curve({0.013, 0.2, 0}, {0.013, -0.03, 0});  // on beyond the hem
  CHECK((!over.begins_at_border && over.ends_at_border));
  CHECK(over.points.back().y() == Approx(0).margin(1e-9));
  CHECK(over.rise[0] == Approx(0.75 * over.length));
  CHECK(over.rise[1] == 0);
  const FoldCurve shy = curve({0.013, 0.2, 0}, {0.013, 0.004, 0});  // it stops short of it
  CHECK(shy.ends_at_border);
  CHECK(shy.points.back().y() == Approx(0).margin(1e-9));
  const FoldCurve across =
      prepare(mesh, {line({{0.013, -0.03, 0}, {0.013, 0.2, 0}, {0.013, 0.43, 0}})}).curves.at(0);
  CHECK((across.begins_at_border && across.ends_at_border));
  CHECK((across.rise[0] == 0 && across.rise[1] == 0));
  const FoldCurve along = curve({-0.1, 0.004, 0}, {0.1, 0.004, 0});  // along the hem
  CHECK_FALSE((along.begins_at_border || along.ends_at_border));
  const FoldCurve inside = curve({-0.2, 0.2, 0}, {0.2, 0.2, 0});
  CHECK(inside.rise[0] == Approx(std::min(1.5 * 0.075, 0.45 * 0.4)));
  Stroke plain = line({{0.013, 0.2, 0}, {0.013, -0.03, 0}});
  plain.flare = false;
  plain.taper = {{0.03, 0}};
  CHECK(prepare(mesh, {plain}).curves.at(0).rise == std::array<double, 2>{0.03, 0});
}

TEST_CASE("prepare_strokes: numbers at points are linear between them") {
  const Mesh mesh = sheet();
  Stroke stroke = line({{-0.2, 0.2, 0}, {0, 0.2, 0}, {0.2, 0.2, 0}});
  stroke.heights = {0.01, 0.03, 0.02};
  stroke.height = 0.03;
  stroke.widths = {0.1, 0.1, 0.2};
  stroke.width = 0.2;
  const FoldCurve curve = prepare(mesh, {stroke}).curves.at(0);
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const double x = curve.points[i].x();
    CHECK(curve.height[i] == Approx(x < 0 ? 0.03 + 0.1 * x : 0.03 - 0.05 * x).margin(1e-4));
    CHECK(curve.width[i] == Approx(x < 0 ? 0.1 : 0.1 + 0.5 * x).margin(2e-3));
  }
  stroke.heights.pop_back();
  CHECK_THROWS_AS(prepare(mesh, {stroke}), ContentError);
}

TEST_CASE("prepare_strokes: a ring around a tube is closed, and a point is no line") {
  const Mesh tube = cylinder(0.1, 0.4, 32, 20);
  std::vector<Point> points;
  for (int i = 0; i < 40; ++i) {
    const double a = 2 * std::numbers::pi * i / 40;
    points.emplace_back(0.1 * std::sin(a), 0.2, 0.1 * std::cos(a));
  }
  Stroke stroke = line(points);
  stroke.closed = true;
  const FoldCurve curve = prepare(tube, {stroke}).curves.at(0);
  CHECK(curve.closed);
  CHECK(curve.length == Approx(2 * std::numbers::pi * 0.1).epsilon(0.01));
  CHECK((curve.rise[0] == 0 && curve.rise[1] == 0));
  CHECK_THROWS_AS(prepare(sheet(), {line({{0, 0.2, 0}})}), ContentError);
}

TEST_CASE("prepare_strokes: a narrow bend is told of a fold, and not of a line that raises no cloth") {
  std::vector<Point> ring;
  for (int i = 0; i < 40; ++i)
    ring.emplace_back(0.03 * std::cos(i * std::numbers::pi / 20),
                      0.2 + 0.03 * std::sin(i * std::numbers::pi / 20), 0);
  for (const double height : {0.01, 0.0}) {
    Stroke stroke = line(ring, height);
    stroke.closed = true;
    stroke.width = 0.08;
    stroke.smooth = 0;
    CHECK(warns(prepare(sheet(), {stroke}), "bends with a radius below half its width") == (height > 0));
  }
}
