// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/self_intersections.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <random>
#include <vector>

#include "geometry/mesh/errors.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

TEST_CASE("count_self_intersections: none in sound meshes, known pairs in crossing ones") {
  for (const Mesh& mesh : {cube(), icosphere(2), torus_lattice(12, 8), grid(6, 6), cylinder(1, 1, 12, 4)})
    CHECK(count_self_intersections(mesh) == 0);
  Mesh crossing = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, -1}, {0.3, 0.2, 1}, {0.2, 0.3, 1}},
                          {{0, 1, 2}, {3, 4, 5}});
  CHECK(count_self_intersections(crossing) == 1);
  crossing.point(Vertex(3)) = Point(0.2, 0.2, 1e-300);  // above by the smallest step: no crossing
  CHECK(count_self_intersections(crossing) == 0);
  crossing.point(Vertex(3)) = Point(0.2, 0.2, 0);  // touches
  CHECK(count_self_intersections(crossing) == 1);
}

TEST_CASE("count_self_intersections: it equals all pairs tested one by one") {
  using Exact = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::mt19937 engine(4);
  const auto uniform = [&] { return engine() / static_cast<double>(std::mt19937::max()); };
  std::vector<Point> points;
  std::vector<std::array<int, 3>> triangles;
  for (int i = 0; i < 120; ++i) {
    const Point c(uniform(), uniform(), uniform());
    for (int k = 0; k < 3; ++k) points.push_back(c + 0.3 * Vector(uniform(), uniform(), uniform()));
    triangles.push_back(
        {3 * i, 3 * i + 1, i > 0 && i % 5 == 0 ? 3 * i - 1 : 3 * i + 2});  // some share a vertex
  }
  std::size_t expected = 0;
  const auto shape = [&](const std::array<int, 3>& t) {
    const auto p = [&](int k) {
      return Exact::Point_3(points[static_cast<std::size_t>(k)].x(), points[static_cast<std::size_t>(k)].y(),
                            points[static_cast<std::size_t>(k)].z());
    };
    return Exact::Triangle_3(p(t[0]), p(t[1]), p(t[2]));
  };
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (std::size_t j = i + 1; j < triangles.size(); ++j) {
      const auto &s = triangles[i], &t = triangles[j];
      if (std::find_first_of(s.begin(), s.end(), t.begin(), t.end()) != s.end()) continue;
      expected += CGAL::do_intersect(shape(s), shape(t));
    }
  REQUIRE(expected > 20);
  CHECK(count_self_intersections(points, triangles) == expected);
}

TEST_CASE("count_self_intersections: parted seams do not touch themselves, degenerate faces are left out") {
  Mesh parted = grid(3, 3);
  Mesh other = grid(3, 3);
  for (Vertex v : other.vertices()) other.point(v) = other.point(v) + Vector(1, 0, 0);
  append(parted, other);  // meets the first along x = 1, vertices at the same positions
  CHECK(count_self_intersections(parted) == 0);
  Mesh degenerate = cube();
  degenerate.point(Vertex(0)) = degenerate.point(Vertex(1));
  CHECK(count_self_intersections(degenerate) == 0);
  Mesh bad = cube();
  bad.point(Vertex(3)) = Point(std::numeric_limits<double>::infinity(), 0, 0);
  CHECK_THROWS_AS(count_self_intersections(bad), ContentError);
  CHECK_THROWS_AS(
      count_self_intersections(std::vector{Point(0, 0, 0)}, std::vector<std::array<int, 3>>{{0, 0, 1}}),
      ContentError);
}

TEST_CASE("count_self_intersections: a book of so many pages that pairs cannot be counted is told") {
  std::vector<Point> points{{0, 0, 0}, {0, 1, 0}};
  std::vector<std::array<int, 3>> pages;
  for (int i = 0; i < 8000; ++i) {
    points.emplace_back(1 + 1e-4 * i, 0.5, 1e-4 * i);
    pages.push_back({0, 1, i + 2});
  }
  CHECK_THROWS_WITH(count_self_intersections(points, pages), Catch::Contains("lie at one place"));
  pages.resize(1000);
  CHECK(count_self_intersections(points, pages) == 0);
}
