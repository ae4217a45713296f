// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/horizontal_section.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/face_point.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

/// Perimeter of the regular n-gon in a circle.
double ngon(double radius, int n) { return 2 * n * radius * std::sin(std::numbers::pi / n); }

std::vector<SectionLoop> horizontal_section(const Mesh& mesh, double height) {
  const std::vector<Point> points(mesh.points().begin(), mesh.points().end());
  std::vector<std::array<int, 3>> triangles;
  for (const Face f : mesh.faces()) {
    const auto c = corners_of(mesh, f);
    triangles.push_back({int(c[0]), int(c[1]), int(c[2])});
  }
  return furrow::geometry::horizontal_section(points, triangles, height);
}

SectionLoop polygon(const std::vector<std::array<double, 2>>& points) {
  SectionLoop loop;
  for (const auto& p : points) loop.points.push_back({p[0], p[1], 0, 1, 0});
  loop.triangles.resize(points.size());
  return loop;
}

}  // namespace

TEST_CASE("horizontal_section: a tube is cut in its polygon at any height, through vertices too") {
  const Mesh tube = cylinder(0.3, 2, 24, 4);
  for (double height : {0.1, 0.5, 1.0, 1.9}) {  // 0.5 and 1: rings of vertices
    const auto loops = horizontal_section(tube, height);
    REQUIRE(loops.size() == 1);
    CHECK(loops[0].closed);
    CHECK(loops[0].length <= Approx(ngon(0.3, 24)).epsilon(1e-12));
    CHECK(loops[0].length >= ngon(0.3, 24) * std::cos(std::numbers::pi / 24));
    CHECK(tape_measure(loops[0]) == Approx(loops[0].length).epsilon(1e-9));
    CHECK(loops[0].triangles.size() == loops[0].points.size());
    CHECK(centre_of(loops[0])[0] == Approx(0).margin(1e-12));
    CHECK(centre_of(loops[0])[1] == Approx(0).margin(1e-12));
    CHECK(enclosed_area(loops[0]) > 0);  // counter-clockwise seen from above: the tube winds outwards
    CHECK(encloses(loops[0], 0.29, 0));
    CHECK_FALSE(encloses(loops[0], 0.31, 0));
  }
  CHECK(horizontal_section(tube, 0.5)[0].length == Approx(ngon(0.3, 24)).epsilon(1e-12));
  CHECK(horizontal_section(tube, -0.1).empty());
  CHECK(horizontal_section(tube, 2.1).empty());
}

TEST_CASE("horizontal_section: a torus is cut in two rings, each by its own length") {
  const Mesh torus = torus_lattice(48, 24, 1, 0.25);
  const auto loops = horizontal_section(torus, 0);
  REQUIRE(loops.size() == 2);
  CHECK(loops[0].length == Approx(ngon(1.25, 48)).epsilon(1e-9));
  CHECK(loops[1].length == Approx(ngon(0.75, 48)).epsilon(1e-9));
  CHECK(enclosed_area(loops[0]) > 0);
  CHECK(enclosed_area(loops[1]) < 0);  // around the hole
  CHECK(encloses(loops[1], 0, 0));
}

TEST_CASE("horizontal_section: points lie on their edges, pieces in their triangles") {
  const Mesh ball = icosphere(3, 0.7, {1, 2, 3});
  std::mt19937 random(5);
  std::uniform_real_distribution<double> heights(1.5, 2.5);
  for (int i = 0; i < 50; ++i) {
    const double y = heights(random);
    const auto loops = horizontal_section(ball, y);
    REQUIRE(loops.size() == 1);
    for (const SectionPoint& p : loops[0].points) {
      const Point a = ball.point(Vertex(p.a)), b = ball.point(Vertex(p.b));
      const Point q = a + p.share * (b - a);
      CHECK(q.x() == Approx(p.x).margin(1e-12));
      CHECK(q.y() == Approx(y).margin(1e-12));
      CHECK(q.z() == Approx(p.z).margin(1e-12));
    }
    // The circle of that height, from inside.
    const double radius = std::sqrt(0.49 - (y - 2) * (y - 2));
    CHECK(loops[0].length < 2 * std::numbers::pi * radius);
    CHECK(loops[0].length > 2 * std::numbers::pi * radius * 0.93);
    CHECK(tape_measure(loops[0]) <= loops[0].length * (1 + 1e-12));
    CHECK(centre_of(loops[0])[0] == Approx(1).margin(0.01));
    CHECK(centre_of(loops[0])[1] == Approx(3).margin(0.01));
  }
}

TEST_CASE("horizontal_section: where the surface has a border the curve is open, and encloses nothing") {
  Mesh sheet = grid(4, 4);  // upright, in the plane z = 0
  const auto loops = horizontal_section(sheet, 0.3);
  REQUIRE(loops.size() == 1);
  CHECK_FALSE(loops[0].closed);
  CHECK(loops[0].length == Approx(1));
  CHECK(loops[0].points.size() == loops[0].triangles.size() + 1);
  CHECK(tape_measure(loops[0]) == Approx(2));  // there and back
  CHECK(enclosed_area(loops[0]) == 0);
  CHECK_FALSE(encloses(loops[0], 0.5, 0));
}

TEST_CASE("tape_measure: it goes straight over hollows") {
  CHECK(tape_measure(polygon({{0, 0}, {2, 0}, {2, 2}, {1, 0.1}, {0, 2}})) == Approx(8));
  CHECK(tape_measure(polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0.5}, {0, 0.5}})) == Approx(4));
  CHECK(tape_measure(polygon({{1, 1}})) == 0);
  CHECK(tape_measure(polygon({})) == 0);
  CHECK_THROWS_AS(centre_of(SectionLoop{}), std::invalid_argument);
  const auto middle = centre_of(polygon({{10, 0}, {12, 0}, {12, 1}, {10, 1}}));
  CHECK(middle[0] == Approx(11));
  CHECK(middle[1] == Approx(0.5));
}

TEST_CASE(
    "breadth: it is the largest of all distances between two points, of round, straight and lattice loops") {
  std::mt19937 random(5);
  for (int round = 0; round < 300; ++round) {
    const int kind = round % 4, n = 1 + static_cast<int>(random() % 40);
    std::vector<std::array<double, 2>> points;
    for (int i = 0; i < n; ++i) {
      const double t = 2 * std::numbers::pi * i / n, u = static_cast<double>(random() % 1000) / 1000;
      if (kind == 0) points.push_back({0.3 * std::cos(t), 0.2 * std::sin(t)});
      if (kind == 1) points.push_back({u, static_cast<double>(random() % 1000) / 1000});
      if (kind == 2) points.push_back({static_cast<double>(random() % 4), static_cast<double>(random() % 3)});
      if (kind == 3) points.push_back({u, 0.5});
    }
    double longest = 0;
    for (const auto& a : points)
      for (const auto& b : points) longest = std::max(longest, std::hypot(a[0] - b[0], a[1] - b[1]));
    INFO(round << ", " << n << " points");
    CHECK(breadth(polygon(points)) == Approx(longest).epsilon(1e-14));
  }
}

TEST_CASE("breadth: of a circle of 200,000 points it is the diameter") {
  std::vector<std::array<double, 2>> points;
  for (int i = 0; i < 200000; ++i) {
    const double t = std::numbers::pi * i / 100000;
    points.push_back({0.3 * std::cos(t), 0.3 * std::sin(t)});
  }
  CHECK(breadth(polygon(points)) == Approx(0.6).epsilon(1e-12));
}

TEST_CASE("horizontal_section: it refuses what it cannot follow") {
  CHECK_THROWS_AS(horizontal_section(cube(), std::numeric_limits<double>::quiet_NaN()),
                  std::invalid_argument);
  const std::vector<Point> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  using Triangles = std::vector<std::array<int, 3>>;
  CHECK_THROWS_AS(horizontal_section(points, Triangles{{0, 1, 4}}, 0.5), std::invalid_argument);
  CHECK_NOTHROW(horizontal_section(points, Triangles{{0, 1, 2}, {2, 1, 3}}, 0.5));
  CHECK_THROWS_AS(horizontal_section(points, Triangles{{0, 1, 2}, {1, 2, 3}}, 0.5), ContentError);
}
