// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/stroke/place_path_stroke.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "geometry/mesh/degenerate_faces.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/face_point.h"
#include "geometry/stroke/shortest_path.h"
#include "tests/geometry/stroke/point_distance.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

double length(const std::vector<Point>& points) {
  double sum = 0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += distance(points[i - 1], points[i]);
  return sum;
}
PlacedStroke place_along_path(const Mesh& mesh, const std::vector<std::size_t>& vertices,
                              bool closed = false) {
  return place_path_stroke(mesh, vertices, closed, "seam");
}

}  // namespace

TEST_CASE("shortest_path: on a plane it is the straight line") {
  const Mesh mesh = jittered(20, 20, 0.2, 5);
  for (const auto& [a, b] : {std::pair{22u, 350u}, {50u, 60u}, {418u, 23u}}) {
    const Point &p = mesh.point(Vertex(a)), &q = mesh.point(Vertex(b));
    const auto path = shortest_path(mesh, Vertex(a), Vertex(b)).points;
    REQUIRE(path.size() > 5);
    CHECK(path.front() == p);
    CHECK(path.back() == q);
    CHECK(length(path) == Approx(distance(p, q)).epsilon(1e-12));
  }
}

TEST_CASE(
    "shortest_path: on a sphere it is close to the great circle, and never longer than along the edges") {
  const Mesh ball = icosphere(4, 1);
  for (const auto& [a, b] : {std::pair{0u, 7u}, {100u, 901u}, {3u, 2000u}}) {
    const Vector u = ball.point(Vertex(a)) - CGAL::ORIGIN, v = ball.point(Vertex(b)) - CGAL::ORIGIN;
    const double arc = std::acos(u * v);
    const auto path = shortest_path(ball, Vertex(a), Vertex(b)).points;
    // A polyhedron inscribed in a sphere with edges l: chords are shorter than arcs by l^2 / 24.
    CHECK(length(path) < arc);
    CHECK(length(path) == Approx(arc).epsilon(2e-3));
    const Vector normal = CGAL::cross_product(u, v) / std::sqrt(CGAL::cross_product(u, v).squared_length());
    for (const Point& p : path) CHECK(std::abs(normal * (p - CGAL::ORIGIN)) < 0.02);
  }
}

TEST_CASE("shortest_path: around a fold it is the unfolded line") {
  // Two faces of a cube: from the lower front edge's left end to the upper back edge's right end.
  const Mesh box = cube();
  const auto at = [&](double x, double y, double z) {
    for (Vertex v : box.vertices())
      if (distance(box.point(v), {x, y, z}) < 1e-12) return v;
    throw std::logic_error("no such corner");
  };
  CHECK(length(shortest_path(box, at(0, 0, 0), at(1, 1, 1)).points) == Approx(std::sqrt(5.0)).epsilon(1e-12));
}

TEST_CASE("place_path_stroke: from vertex to vertex, one point in each crossed face") {
  const Mesh mesh = jittered(20, 20, 0.2, 5);
  const PlacedStroke placed = place_along_path(mesh, {22, 350, 360});
  CHECK(placed.points.front() == mesh.point(Vertex(22)));
  CHECK(placed.points.back() == mesh.point(Vertex(360)));
  CHECK(length(placed.points) == Approx(distance(mesh.point(Vertex(22)), mesh.point(Vertex(350))) +
                                        distance(mesh.point(Vertex(350)), mesh.point(Vertex(360)))));
  CHECK(place_along_path(mesh, {5}).points == std::vector<Point>{mesh.point(Vertex(5))});
  const PlacedStroke loop = place_along_path(mesh, {22, 38, 350}, true);
  CHECK(loop.closed);
  CHECK(loop.points.back() != loop.points.front());
}

TEST_CASE("place_path_stroke: what cannot be joined is refused by stroke and place") {
  Mesh mesh = grid(4, 4);
  append(mesh, icosphere(1, 0.2, {5, 5, 5}));
  const auto lone = mesh.add_vertex(Point(0, 0, 1)).idx();
  CHECK_THROWS_WITH(place_along_path(mesh, {0, 9999}),
                    Catch::StartsWith("stroke \"seam\", point 1: there is no vertex 9999"));
  CHECK_THROWS_WITH(place_along_path(mesh, {0, lone}), Catch::Contains("belongs to no face"));
  CHECK_THROWS_WITH(place_along_path(mesh, {0, 30}), Catch::Contains("no cloth joins vertices 0 and 30"));
  CHECK_THROWS_WITH(place_along_path(mesh, {3, 3}), Catch::Contains("vertex 3 is repeated"));
  CHECK_THROWS_AS(place_along_path(mesh, {}), ContentError);
}

namespace {

/// A sheet with 1 to 3 faces collapsed: to a point, to an edge, or to a line with its corners apart, whole or
/// but for a rest of the edge that is too small to count.
Mesh sheet_with_collapsed_faces(std::mt19937& random) {
  Mesh mesh = jittered(8, 8, 0.2, random(), 0.4, 0.4);
  const auto pick = [&](std::size_t n) { return random() % n; };
  for (std::size_t k = 0, n = 1 + pick(3); k < n; ++k) {
    const auto c = corners_of(mesh, Face(pick(mesh.number_of_faces())));
    const Vector rest = pick(2) ? Vector(0, 0, 0) : Vector(0, 0, 1e-14);
    switch (pick(3)) {
      case 0:
        mesh.point(c[1]) = mesh.point(c[0]) + rest, mesh.point(c[2]) = mesh.point(c[0]);
        break;
      case 1:
        mesh.point(c[1]) = mesh.point(c[0]) + rest;
        break;
      default:
        mesh.point(c[1]) = CGAL::midpoint(mesh.point(c[0]), mesh.point(c[2])) + rest;
    }
  }
  return mesh;
}

}  // namespace

TEST_CASE("place_path_stroke: 1,000 strokes on sheets with collapsed faces are laid or refused", "[long]") {
  std::mt19937 random(17);
  int laid = 0, refused = 0;
  for (int k = 0; k < 1000; ++k) {
    const Mesh mesh = sheet_with_collapsed_faces(random);
    REQUIRE(!degenerate_faces(mesh).empty());
    const std::vector<std::size_t> ends{random() % 81, 81 + random() % 80};
    const std::vector<std::size_t> stops{ends[0], (ends[0] + 1 + ends[1] % 80) % 81};
    try {
      const double way = length(place_along_path(mesh, stops).points);
      const double straight = distance(mesh.point(Vertex(stops[0])), mesh.point(Vertex(stops[1])));
      // The sheet is flat, so that a way that is no straight line went round a collapsed face.
      CHECK(way == Approx(straight).margin(1e-9));
      ++laid;
    } catch (const ContentError& e) {
      CHECK_THAT(e.what(), Catch::Contains("is degenerate (it has no area)"));
      ++refused;
    }
  }
  CHECK(laid > 200);
  CHECK(refused > 200);
}

TEST_CASE("place_path_stroke: a collapsed face is named with its place, and one aside is no matter") {
  Mesh mesh = grid(10, 10);
  mesh.point(Vertex(0)) = mesh.point(Vertex(1));
  CHECK_THROWS_WITH(place_along_path(mesh, {1, 5}),
                    Catch::Contains("face 0 at (0.1, 0.03333, 0) m, which is degenerate") &&
                        Catch::Contains("draw this stroke by points"));
  CHECK(length(place_along_path(mesh, {60, 65}).points) == Approx(0.5));
  CHECK_THROWS_WITH(place_along_path(mesh, {0, 5}), Catch::Contains("is degenerate"));
}

TEST_CASE("degenerate_faces: collapsed to a point, an edge, or a line, at any scale") {
  for (double size : {1e-30, 1e-6, 1.0, 1e30}) {
    const Mesh mesh = mesh_of({{0, 0, 0},
                               {size, 0, 0},
                               {0, size, 0},
                               {2 * size, 0, 0},
                               {0, 0, 0},
                               {size, 1e-13 * size, 0},
                               {size, -1e-6 * size, 0}},
                              {{0, 1, 2}, {0, 3, 1}, {4, 0, 2}, {3, 4, 5}, {6, 3, 0}});
    CHECK(degenerate_faces(mesh) == std::vector<Face>{Face(1), Face(2), Face(3)});
  }
}
