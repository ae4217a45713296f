// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/stroke/place_path_stroke.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "geometry/mesh/errors.h"
#include "geometry/stroke/shortest_path.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

double distance(const Point& a, const Point& b) { return std::sqrt(CGAL::squared_distance(a, b)); }
double length(const std::vector<Point>& points) {
  double sum = 0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += distance(points[i - 1], points[i]);
  return sum;
}
PlacedStroke place(const Mesh& mesh, const std::vector<std::size_t>& vertices, bool closed = false) {
  return place_path_stroke(mesh, vertices, closed, "seam");
}

}  // namespace

TEST_CASE("shortest_path: on a plane it is the straight line") {
  const Mesh mesh = jittered(20, 20, 0.2, 5);
  for (const auto& [a, b] : {std::pair{22u, 350u}, {50u, 60u}, {418u, 23u}}) {
    const Point &p = mesh.point(Vertex(a)), &q = mesh.point(Vertex(b));
    const auto path = shortest_path(mesh, Vertex(a), Vertex(b));
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
    const auto path = shortest_path(ball, Vertex(a), Vertex(b));
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
  CHECK(length(shortest_path(box, at(0, 0, 0), at(1, 1, 1))) == Approx(std::sqrt(5.0)).epsilon(1e-12));
}

TEST_CASE("place_path_stroke: from vertex to vertex, one point in each crossed face") {
  const Mesh mesh = jittered(20, 20, 0.2, 5);
  const PlacedStroke placed = place(mesh, {22, 350, 360});
  CHECK(placed.points.front() == mesh.point(Vertex(22)));
  CHECK(placed.points.back() == mesh.point(Vertex(360)));
  CHECK(length(placed.points) == Approx(distance(mesh.point(Vertex(22)), mesh.point(Vertex(350))) +
                                        distance(mesh.point(Vertex(350)), mesh.point(Vertex(360)))));
  CHECK(place(mesh, {5}).points == std::vector<Point>{mesh.point(Vertex(5))});
  const PlacedStroke loop = place(mesh, {22, 38, 350}, true);
  CHECK(loop.closed);
  CHECK(loop.points.back() != loop.points.front());
}

TEST_CASE("place_path_stroke: what cannot be joined is refused by stroke and place") {
  Mesh mesh = grid(4, 4);
  append(mesh, icosphere(1, 0.2, {5, 5, 5}));
  const auto lone = mesh.add_vertex(Point(0, 0, 1)).idx();
  CHECK_THROWS_WITH(place(mesh, {0, 9999}),
                    Catch::StartsWith("stroke \"seam\", point 1: there is no vertex 9999"));
  CHECK_THROWS_WITH(place(mesh, {0, lone}), Catch::Contains("belongs to no face"));
  CHECK_THROWS_WITH(place(mesh, {0, 30}), Catch::Contains("no cloth joins vertices 0 and 30"));
  CHECK_THROWS_WITH(place(mesh, {3, 3}), Catch::Contains("vertex 3 is repeated"));
  CHECK_THROWS_AS(place(mesh, {}), ContentError);
}
