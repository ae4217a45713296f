// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/rest/rest_metric.h"

#include <CGAL/boost/graph/Euler_operations.h>
#include <rapidcheck.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "geometry/rest/rest_state.h"
#include "geometry/rest/stiffness.h"
#include "tests/geometry/insert/insertion_meshes.h"
#include "tests/test_meshes.h"

namespace furrow::tests {

using namespace geometry;

namespace {

/// The square 0, 1, 2, 3 of side 1, cut along 0-2.
Mesh square() {
  Mesh mesh;
  for (const Point& p : {Point(0, 0, 0), Point(1, 0, 0), Point(1, 1, 0), Point(0, 1, 0)}) mesh.add_vertex(p);
  mesh.add_face(Vertex(0), Vertex(1), Vertex(2));
  mesh.add_face(Vertex(0), Vertex(2), Vertex(3));
  return mesh;
}

}  // namespace

TEST_CASE("rest_metric: known triangles have their areas and angles") {
  CHECK(triangle_area({3, 4, 5}) == Approx(6).epsilon(1e-15));
  CHECK(triangle_area({1, 2, 4}) == 0);
  CHECK(std::isnan(triangle_area({1, unset_value, 1})));
  const auto angles = triangle_angles({4, 5, 3});  // corner 0 between the sides 4 and 3
  CHECK(angles[0] == Approx(std::numbers::pi / 2));
  CHECK(smallest_angle({4, 5, 3}) == Approx(std::atan2(3, 4)));
  const auto spokes = lengths_to_corners({1, 1, 1}, {1.0 / 3, 1.0 / 3, 1.0 / 3});
  for (double l : spokes) CHECK(l == Approx(1 / std::numbers::sqrt3).epsilon(1e-14));
  const Barycentrics in = incenter({4, 5, 3});  // inradius 1
  CHECK(2 * 6 * in[0] / 5 == Approx(1));
  CHECK(2 * 6 * in[1] / 3 == Approx(1));
  CHECK(is_proper_triangle({3, 4, 5}));
  CHECK_FALSE(is_proper_triangle({1, 2, 3}));
  CHECK_FALSE(is_proper_triangle({0, 1, 1}));
}

TEST_CASE("rest_metric: rest lengths that are set stay, the others are lengths in space") {
  Mesh mesh = square();
  ensure_map(mesh, attribute::rest_length)[Edge(0)] = 7;
  const auto rest = ensure_rest_lengths(mesh);
  CHECK(rest[Edge(0)] == 7);
  CHECK(rest[mesh.edge(mesh.halfedge(Vertex(0), Vertex(2)))] == Approx(std::numbers::sqrt2));
  CHECK(mean_rest_length(mesh) == Approx((7 + 3 + std::numbers::sqrt2) / 5));
}

TEST_CASE("rest_metric: the diagonal of a square unfolds to the other one, also on a bent square") {
  Mesh mesh = square();
  const auto rest = ensure_rest_lengths(mesh);
  mesh.point(Vertex(3)) = Point(0.2, 0.3, 0.8);
  const Edge diagonal = mesh.edge(mesh.halfedge(Vertex(0), Vertex(2)));
  const UnfoldedPair pair = unfold(mesh, rest, diagonal);
  CHECK(pair.flipped_length() == Approx(std::numbers::sqrt2).epsilon(1e-15));
  CHECK(pair.flipped_areas()[0] == Approx(0.5));
  CHECK(pair.flipped_areas()[1] == Approx(0.5));
  CHECK(cotangent_sum(mesh, rest, diagonal) == Approx(0).margin(1e-15));
}

TEST_CASE("rest_metric: a flip that would fold over has a negative area") {
  Mesh mesh = square();
  mesh.point(Vertex(1)) = Point(0.9, 0.6, 0);  // the corner at vertex 2 becomes reflex with respect to 1-3
  mesh.point(Vertex(2)) = Point(0.6, 0.7, 0);
  const auto rest = ensure_rest_lengths(mesh);
  const auto areas = unfold(mesh, rest, mesh.edge(mesh.halfedge(Vertex(0), Vertex(2)))).flipped_areas();
  CHECK(std::min(areas[0], areas[1]) < 0);
}

TEST_CASE("rest_metric: lengths to the corners are distances in the plane") {
  CHECK(rc::check([] {
    const auto number = [](int low, int high) {
      return *rc::gen::resize(100, rc::gen::inRange(low, high)) / 100.0;
    };
    const Point a(0, 0, 0), b(number(10, 300), 0, 0), c(number(-200, 200), number(10, 300), 0);
    const double u = number(1, 98), v = number(1, 98) * (1 - u);
    const Barycentrics beta{1 - u - v, u, v};
    const Point p = CGAL::ORIGIN + u * (b - a) + v * (c - a);
    const auto distance = [](const Point& x, const Point& y) {
      return std::sqrt(CGAL::squared_distance(x, y));
    };
    const auto lengths = lengths_to_corners({distance(a, b), distance(b, c), distance(c, a)}, beta);
    RC_ASSERT(std::abs(lengths[0] - distance(p, a)) < 1e-12);
    RC_ASSERT(std::abs(lengths[1] - distance(p, b)) < 1e-12);
    RC_ASSERT(std::abs(lengths[2] - distance(p, c)) < 1e-12);
  }));
}

TEST_CASE("rest_metric: the audit sees inverted faces, duplicate edges and the smallest angle") {
  Mesh mesh = square();
  CHECK(audit_rest_metric(mesh).min_angle_deg == Approx(45));
  CHECK(audit_rest_metric(mesh).area == Approx(1));
  CHECK(audit_rest_metric(mesh).duplicate_edges == 0);
  ensure_rest_lengths(mesh)[mesh.edge(mesh.halfedge(Vertex(0), Vertex(1)))] = 9;
  CHECK(audit_rest_metric(mesh).inverted_faces == 1);
  CHECK(audit_rest_metric(mesh).min_angle_deg == 0);
  // An edge of a tetrahedron, flipped, joins two corners that another edge joins already.
  Mesh flipped =
      mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  CHECK(audit_rest_metric(flipped).duplicate_edges == 0);
  CGAL::Euler::flip_edge(flipped.halfedge(Vertex(0), Vertex(1)), flipped);
  CHECK(audit_rest_metric(flipped).duplicate_edges == 1);
}

}  // namespace furrow::tests
