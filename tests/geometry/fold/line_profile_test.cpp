// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/line_profile.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "geometry/fold/line_height.h"
#include "geometry/fold/wrinkle.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/sheet.h"
#include "tests/cases/safe_rule.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

constexpr double fold_width = 0.06, fold_height = 0.01;

Stroke fold(const std::vector<Point>& points, double height = fold_height, double sharpness = 0.5) {
  Stroke stroke;
  stroke.height = height;
  stroke.points.assign(points.begin(), points.end());
  stroke.width = fold_width;
  stroke.sharpness = sharpness;
  return stroke;
}
Stroke oblique(double sharpness = 0.5) {
  return fold({{-0.1, 0.12, 0}, {0.1, 0.23, 0}}, fold_height, sharpness);
}

/// From the stroke of oblique() [m].
double from_oblique(double x, double y) {
  const double dx = 0.2, dy = 0.11, l2 = dx * dx + dy * dy;
  const double t = std::clamp(((x + 0.1) * dx + (y - 0.12) * dy) / l2, 0.0, 1.0);
  return std::hypot(x + 0.1 - t * dx, y - 0.12 - t * dy);
}

/// The plane as a tube of that radius around the y axis.
Point bent(const Point& p, double radius) {
  return {radius * std::sin(p.x() / radius), p.y(), radius * std::cos(p.x() / radius)};
}

Mesh raised(Mesh mesh, const std::vector<Stroke>& strokes, const WrinkleOptions& options = safe_rule()) {
  wrinkle(mesh, strokes, options);
  return mesh;
}

/// z of the vertex nearest to (x, y).
double height_at(const Mesh& mesh, double x, double y) {
  Vertex nearest(0);
  const auto d = [&](Vertex v) { return std::hypot(mesh.point(v).x() - x, mesh.point(v).y() - y); };
  for (Vertex v : mesh.vertices())
    if (d(v) < d(nearest)) nearest = v;
  return mesh.point(nearest).z();
}

}  // namespace

TEST_CASE("line_profile: crest, half way, foot and beyond, round and sharp") {
  for (double s : {0.0, 0.3, 1.0}) {
    CHECK(line_profile(0, s) == 1);
    CHECK(line_profile(0.5, s) == Approx(0.5));
    CHECK(line_profile(1, s) == 0);
    CHECK(line_profile(3, s) == 0);
    const double slope = (line_profile(1e-6, s) - 1) / 1e-6;
    CHECK(slope == Approx(-s).margin(1e-5));
  }
  CHECK(line_profile(0.25, 0) == Approx((1 + std::sqrt(0.5)) / 2));
  CHECK(line_profile(0.25, 1) == 0.75);
}

TEST_CASE("line_profile: a line with a width has the same heights and cross-section on every mesh",
          "[long]") {
  for (double sharpness : {0.0, 0.5, 1.0})
    for (double h : {0.02, 0.01, 0.005}) {
      Mesh mesh = equilateral_sheet(0.4, 0.4, h);
      const std::vector<Stroke> strokes{oblique(sharpness)};
      const WrinkleReport report = wrinkle(mesh, strokes, safe_rule());
      CHECK(report.lines[0].drawn_height == Approx(fold_height).epsilon(1e-9));
      CHECK(report.lines[0].smoothed_height == Approx(fold_height).epsilon(1e-9));  // it is not smoothed
      const auto line = *find_map(mesh, attribute::line);
      for (Vertex v : mesh.vertices()) {
        const Point& p = mesh.point(v);
        const double asked =
            fold_height * line_profile(from_oblique(p.x(), p.y()) / (fold_width / 2), sharpness);
        // The line goes through the faces' vertices, and may lie a fifth of an edge beside the stroke.
        CHECK(p.z() ==
              Approx(line[v] < 0 ? asked : fold_height).margin(line[v] < 0 ? 0.02 * fold_height : 1e-12));
      }
    }
}

TEST_CASE("line_profile: a line with a width on curved cloth has one height on coarse and fine meshes") {
  std::vector<double> heights;
  for (double h : {0.02, 0.01, 0.005}) {
    Mesh mesh = equilateral_sheet(0.4, 0.4, h);
    for (Vertex v : mesh.vertices()) mesh.point(v) = bent(mesh.point(v), 0.15);
    Stroke stroke = oblique();
    stroke.points.clear();
    for (int i = 0; i <= 50; ++i)
      stroke.points.push_back(bent(Point(-0.1 + 0.2 * i / 50, 0.12 + 0.11 * i / 50, 0), 0.15));
    const std::vector<Stroke> strokes{stroke};
    heights.push_back(wrinkle(mesh, strokes, safe_rule()).lines[0].smoothed_height);
  }
  for (double height : heights) CHECK(height == Approx(fold_height).epsilon(0.02));
}

TEST_CASE("line_profile: a fold moves no other layer, neither a second sheet nor the other leg of a bend") {
  Mesh two = equilateral_sheet(0.4, 0.4, 0.01);
  const std::size_t first = two.number_of_vertices();
  Mesh over = equilateral_sheet(0.4, 0.4, 0.01);
  lift(over, [](double, double) { return -0.006; });
  append(two, over);
  const Mesh result = raised(two, {oblique()});
  for (std::size_t i = first; i < 2 * first; ++i) {
    const Vertex v(static_cast<Vertex::size_type>(i));
    CHECK(result.point(v) == two.point(v));
  }
  // A hairpin: two legs, 6 mm apart, joined far from the line.
  Mesh pin = equilateral_sheet(0.4, 0.4, 0.01);
  for (Vertex v : pin.vertices())
    if (const Point p = pin.point(v); p.x() > 0) pin.point(v) = {-p.x(), p.y(), -0.006};
  const Mesh bent_back = raised(pin, {fold({{-0.12, 0.1, 0}, {-0.12, 0.3, 0}})});
  for (Vertex v : pin.vertices())
    if (pin.point(v).z() < -0.005) CHECK(bent_back.point(v) == pin.point(v));
}

TEST_CASE("line_profile: where folds meet the highest ridge, the deepest valley, and both together count",
          "[long]") {
  const Mesh sheet = equilateral_sheet(0.4, 0.4, 0.005);
  const Stroke across = fold({{-0.15, 0.201, 0}, {0.15, 0.201, 0}}, 0.01),
               up = fold({{0.001, 0.05, 0}, {0.001, 0.35, 0}}, 0.02);
  for (const auto& both : {std::vector{across, up}, std::vector{up, across}}) {  // in any order
    const Mesh mesh = raised(sheet, both);
    CHECK(height_at(mesh, 0, 0.2) == Approx(0.02).epsilon(0.03));
    CHECK(height_at(mesh, 0.1, 0.201) == Approx(0.01));
    for (Vertex v : mesh.vertices()) CHECK(mesh.point(v).z() >= 0);
  }
  Stroke valley = across;
  valley.height = -0.01;
  const Mesh mesh = raised(sheet, {up, valley});
  CHECK(height_at(mesh, 0.001, 0.201) == Approx(0.01).epsilon(0.1));  // 20 - 10
  CHECK(height_at(mesh, 0.1, 0.201) == Approx(-0.01));
}

TEST_CASE("line_profile: on a grid of right angles the fold goes to its feet, too, along the diagonals") {
  Mesh mesh;
  constexpr int n = 40;
  constexpr double step = 0.005;
  std::vector<Vertex> v;
  for (int r = 0; r <= n; ++r)
    for (int c = 0; c <= n; ++c) v.push_back(mesh.add_vertex({step * c, step * r, 0}));
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const int a = r * (n + 1) + c;
      mesh.add_face(v[a], v[a + 1], v[a + n + 2]);
      mesh.add_face(v[a], v[a + n + 2], v[a + n + 1]);
    }
  const Point from(0.05, 0.05, 0), to(0.15, 0.15, 0);
  const Mesh folded = raised(mesh, {fold({from, to}, fold_height, 1)});
  for (const Vertex u : mesh.vertices()) {  // new vertices come after these
    const Point& p = mesh.point(u);
    const double along = (p.x() + p.y()) / std::sqrt(2), across = std::abs(p.x() - p.y()) / std::sqrt(2);
    if (along < 0.08 || along > 0.2 || across < 0.01) continue;
    CHECK(folded.point(u).z() ==
          Approx(fold_height * std::max(0.0, 1 - across / (fold_width / 2))).margin(2e-4));
  }
}

TEST_CASE(
    "line_profile: a line without a width that crosses a fold is smoothed, whichever is first in the file") {
  Stroke plain;
  plain.height = 0.02;
  plain.points = {{0, 0.08, 0}, {0, 0.26, 0}};
  const Stroke wide = fold({{-0.1, 0.17, 0}, {0.1, 0.17, 0}});
  const Mesh sheet = equilateral_sheet(0.3, 0.3, 0.01);
  const Mesh alone = raised(sheet, {plain}), one = raised(sheet, {plain, wide}),
             two = raised(sheet, {wide, plain});
  CHECK(height_at(one, 0, 0.17) == Approx(height_at(two, 0, 0.17)).margin(2e-3));
  CHECK(height_at(one, 0, 0.17) == Approx(height_at(alone, 0, 0.17) + fold_height).margin(2e-3));
}

TEST_CASE("line_profile: a fold's press reaches hinges whose stiffness is stored") {
  Mesh mesh = equilateral_sheet(0.3, 0.3, 0.01);
  auto stiffness = mesh.add_property_map<Edge, double>(attribute::hinge_stiffness.name, unset_value).first;
  for (Edge e : mesh.edges()) stiffness[e] = 2;
  Stroke pressed = fold({{-0.1, 0.17, 0}, {0.1, 0.17, 0}});
  pressed.press = 10;
  wrinkle(mesh, std::vector<Stroke>{pressed}, safe_rule());
  const auto after = find_map(mesh, attribute::hinge_stiffness);
  REQUIRE(after);
  int near = 0, pressed_edges = 0;
  for (Edge e : mesh.edges()) {
    const Point &a = mesh.point(mesh.vertex(e, 0)), &b = mesh.point(mesh.vertex(e, 1));
    if (!std::isfinite((*after)[e])) continue;  // of changed faces: gather() makes it, and presses it
    if (std::abs(a.y() - 0.17) < 0.02 && std::abs(b.y() - 0.17) < 0.02 && std::abs(a.x()) < 0.1)
      ++near, pressed_edges += (*after)[e] == 20;
    if (std::abs(a.y() - 0.17) > 0.06 && std::abs(b.y() - 0.17) > 0.06) CHECK((*after)[e] == 2);
  }
  CHECK(pressed_edges == near);
  CHECK(near > 50);
}

TEST_CASE("line_profile: a fold along a border has a height that nobody can measure, and says so") {
  Mesh mesh = equilateral_sheet(0.3, 0.3, 0.01);
  Stroke hem = fold({{-0.149, 0.02, 0}, {0.149, 0.02, 0}});
  const WrinkleReport report = wrinkle(mesh, std::vector<Stroke>{hem}, safe_rule());
  CHECK(std::isnan(report.lines.at(0).drawn_height));
  CHECK(std::isfinite(height_at(mesh, 0, 0.02)));
  CHECK(height_at(mesh, 0, 0.02) > 0.5 * fold_height);
}

TEST_CASE("line_profile: a fold over the border raises the hem, and what is held stays") {
  Mesh sheet = equilateral_sheet(0.4, 0.4, 0.01);
  WrinkleOptions options = safe_rule();
  for (Vertex v : sheet.vertices())
    if (sheet.point(v).y() > 0.3999) options.held.push_back(v);
  const Mesh mesh =
      raised(sheet, {fold({{0.003, -0.01, 0}, {0.003, 0.1, 0}, {0.003, 0.3, 0}, {0.003, 0.41, 0}})}, options);
  CHECK(height_at(mesh, 0.003, 0) == Approx(fold_height));
  CHECK(height_at(mesh, 0.018, 0) == Approx(fold_height / 2).epsilon(0.2));
  for (Vertex v : options.held) CHECK(mesh.point(v) == sheet.point(v));
}

TEST_CASE("line_profile: a line without a width keeps its bits beside one with a width") {
  const Mesh sheet = equilateral_sheet(0.4, 0.4, 0.01);
  Stroke plain = fold({{-0.15, 0.08, 0}, {0.15, 0.09, 0}});
  plain.width.reset();
  const Mesh alone = raised(sheet, {plain}),
             both = raised(sheet, {plain, fold({{-0.1, 0.3, 0}, {0.1, 0.3, 0}})});
  REQUIRE(both.number_of_vertices() > alone.number_of_vertices());
  for (Vertex v : alone.vertices())
    if (alone.point(v).y() < 0.2) CHECK(alone.point(v) == both.point(v));
}

TEST_CASE("line_profile: wrinkle warns of a mesh too coarse for the width, and refuses shapes out of range") {
  Mesh coarse = equilateral_sheet(0.4, 0.4, 0.03), fine = equilateral_sheet(0.4, 0.4, 0.01);
  const std::vector<Stroke> strokes{oblique()};
  const WrinkleReport report = wrinkle(coarse, strokes, safe_rule());
  REQUIRE(report.warnings.size() == 1);
  CHECK(report.warnings[0].find("60 mm") != std::string::npos);
  Mesh again = fine;
  CHECK(wrinkle(fine, strokes, safe_rule()).warnings.empty());
  const auto refused = [&](auto change, const char* what) {
    Stroke stroke = oblique();
    stroke.name = "belly";
    change(stroke);
    CHECK_THROWS_WITH(wrinkle(again, std::span(&stroke, 1), safe_rule()),
                      Catch::Contains("belly") && Catch::Contains(what));
  };
  refused([](Stroke& s) { s.width = 0; }, "'width' = 0");
  refused([](Stroke& s) { s.width = INFINITY; }, "'width'");
  refused([](Stroke& s) { s.sharpness = 1.5; }, "'sharpness' = 1.5");
  refused([](Stroke& s) { s.press = 0.5; }, "'press' = 0.5");
  CHECK_FALSE(find_map(again, attribute::line));
}
