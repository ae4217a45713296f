// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/wrinkle.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/sheet.h"
#include "tests/cases/safe_rule.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;

namespace {

Stroke across(double height, double y = 0.31) {
  Stroke stroke;
  stroke.height = height;
  stroke.points = {{-0.2, y, 0}, {0.2, y + 0.03, 0}};
  return stroke;
}

double largest_strain(const Mesh& mesh) {
  const auto rest = *find_map(mesh, attribute::rest_length);
  double largest = 0;
  for (Edge e : mesh.edges()) {
    const double l =
        std::sqrt(CGAL::squared_distance(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));
    largest = std::max(largest, std::abs(l - rest[e]) / rest[e]);
  }
  return largest;
}

}  // namespace

TEST_CASE("wrinkle: it leaves a flat sheet at rest as drawn, and adds the cloth that it reports") {
  Mesh mesh = equilateral_sheet(0.6, 0.6, 0.02);
  const std::vector<Stroke> strokes{across(0.02), across(-0.015, 0.1)};
  std::vector<Stage> stages;
  const WrinkleReport report =
      wrinkle(mesh, strokes, furrow::tests::safe_rule(), [&](Stage s, const Mesh&) { stages.push_back(s); });
  CHECK(largest_strain(mesh) < 1e-12);
  CHECK(report.rest_area_after > report.rest_area_before);
  CHECK(report.total_mass == Approx(0.15 * report.rest_area_after));
  CHECK(report.lines[0].drawn_height == Approx(0.02).epsilon(0.01));
  CHECK(report.lines[1].smoothed_height < -0.005);
  CHECK(stages == std::vector<Stage>{Stage::inserted, Stage::displaced, Stage::smoothed});
}

TEST_CASE("wrinkle: a line of height 0 without smoothing is an isometry, and so is flat rest") {
  Mesh mesh = equilateral_sheet(0.6, 0.6, 0.02);
  const std::vector<Stroke> nothing{across(0)}, ridge{across(0.02)};
  WrinkleOptions options = furrow::tests::safe_rule();
  options.smoothing.iterations = 0;
  const WrinkleReport zero = wrinkle(mesh, nothing, options);
  CHECK(zero.rest_area_after == Approx(zero.rest_area_before).epsilon(1e-12));
  CHECK(largest_strain(mesh) < 1e-12);
  options.rest = RestRule::flat;
  options.first_line = 1;
  const WrinkleReport flat = wrinkle(mesh, ridge, options);
  CHECK(flat.rest_area_after == Approx(flat.rest_area_before).epsilon(1e-12));
  CHECK(largest_strain(mesh) > 0.1);
}

TEST_CASE("wrinkle: it changes nothing when a stroke or an option is refused") {
  Mesh mesh = equilateral_sheet(0.6, 0.6, 0.02);
  const std::size_t vertices = mesh.number_of_vertices();
  std::vector<Stroke> strokes{across(0.02), across(0.02)};
  strokes[1].points[0] = {0, 0, 9};
  CHECK_THROWS_AS(wrinkle(mesh, strokes), ContentError);
  strokes.pop_back();
  WrinkleOptions bad;
  bad.smoothing.mu = -0.2;
  CHECK_THROWS_AS(wrinkle(mesh, strokes, bad), std::invalid_argument);
  bad = {};
  bad.density = 0;
  CHECK_THROWS_AS(wrinkle(mesh, strokes, bad), std::invalid_argument);
  CHECK(mesh.number_of_vertices() == vertices);
  CHECK_FALSE(find_map(mesh, attribute::line));
}

TEST_CASE("wrinkle: on coarse curved cloth a line of height 0 reads 0, and one of height k about k") {
  // Half a tube of radius 0.15 m with edges of about 5 cm: the fill of two rings sags by some 8 mm.
  Mesh curved = furrow::tests::grid(10, 10, 0.47, 0.5);
  for (Vertex v : curved.vertices()) {
    const Point p = curved.point(v);
    curved.point(v) = Point(0.15 * std::cos(p.x() / 0.15), p.y(), -0.15 * std::sin(p.x() / 0.15));
  }
  Stroke along;
  along.points = {{0.01, 0.06, -0.15}, {0.012, 0.44, -0.15}};
  WrinkleOptions plain = furrow::tests::safe_rule();
  plain.smoothing.iterations = 0;
  for (double k : {0., 0.02, -0.015}) {
    Mesh mesh = curved;
    along.height = k;
    const WrinkledLine line = wrinkle(mesh, std::vector<Stroke>{along}, plain).lines[0];
    CHECK(line.base_height > 0.002);
    // The lifted line also lifts the fill's natural border; on a plane it would not.
    CHECK(line.drawn_height == Approx(k).margin(0.1 * std::abs(k)));
    CHECK(line.smoothed_height == Approx(line.drawn_height).epsilon(0.02));  // the rest metric has changed
  }
}
