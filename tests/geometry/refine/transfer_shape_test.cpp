// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/refine/transfer_shape.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "geometry/fold/wrinkle.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/refine/subdivide.h"
#include "tests/cases/safe_rule.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

Stroke ridge() {
  Stroke stroke;
  stroke.height = 0.03;
  for (int i = 0; i <= 50; ++i) stroke.points.push_back(Point(0.2 + 0.012 * i, 0.5 + 0.002 * i, 0));
  return stroke;
}

void note_rest(Mesh& mesh) {
  auto rest = ensure_map(mesh, attribute::rest_position);
  for (Vertex v : mesh.vertices()) rest[v] = {mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z()};
}

/// Turned about x by 90 degrees and moved.
Point posed(const Point& p) { return {p.x() + 2, -p.z() + 1, p.y()}; }

}  // namespace

TEST_CASE("transfer: surviving vertices are copied, all else of the original stays") {
  Mesh original = jittered(20, 20, 0.2, 5);
  auto texture = ensure_map(original, attribute::texture);
  for (Halfedge h : original.halfedges()) texture[h] = {h.idx() / 3.0, 0};
  Mesh wrinkled = original;
  const std::vector<Stroke> strokes{ridge()};
  wrinkle(wrinkled, strokes, furrow::tests::safe_rule());
  Mesh result = original;
  const TransferReport report = transfer_shape(result, wrinkled);
  CHECK(report.copied == original.number_of_vertices());
  CHECK(report.interpolated == 0);
  CHECK(report.unchanged > 200);
  CHECK(report.unchanged < original.number_of_vertices() - 50);
  CHECK(result.number_of_faces() == original.number_of_faces());
  for (Vertex v : original.vertices()) CHECK(result.point(v) == wrinkled.point(v));
  for (Halfedge h : original.halfedges()) {
    CHECK(result.target(h) == original.target(h));
    CHECK((*find_map(result, attribute::texture))[h] == texture[h]);
  }
  // Posed, without another note of the pose.
  for (Vertex v : wrinkled.vertices()) wrinkled.point(v) = posed(wrinkled.point(v));
  Mesh moved = original;
  transfer_shape(moved, wrinkled);
  for (Vertex v : original.vertices()) CHECK(moved.point(v) == posed(result.point(v)));
}

TEST_CASE("transfer: a garment that was subdivided first moves by the closest rest point") {
  Mesh original = cylinder(0.2, 0.6, 24, 12);
  Mesh fine = original;
  midpoint_subdivide(fine, 1);
  loop_subdivide(fine, 1);  // shrinks: the original's vertices lie beside the rest surface
  note_rest(fine);
  Mesh untouched = original;
  const TransferReport same = transfer_shape(untouched, fine);
  CHECK(same.interpolated > 0);
  CHECK(same.unchanged == original.number_of_vertices());
  CHECK(same.max_distance > 1e-4);
  for (Vertex v : original.vertices()) CHECK(untouched.point(v) == original.point(v));
  // A rigid motion of the fine mesh moves the original alike, offsets and all.
  Mesh turned = original;
  for (Vertex v : fine.vertices()) fine.point(v) = posed(fine.point(v));
  transfer_shape(turned, fine);
  for (Vertex v : original.vertices())
    CHECK(CGAL::squared_distance(turned.point(v), posed(original.point(v))) < 1e-26);
}

TEST_CASE("transfer: what cannot be done is said, and the original stays") {
  Mesh original = grid(4, 4);
  const Mesh before = original;
  CHECK_THROWS_AS(transfer_shape(original, grid(4, 4)), ContentError);
  Mesh far = grid(4, 4);
  lift(far, [](double, double) { return 0.5; });
  note_rest(far);
  CHECK_THROWS_WITH(transfer_shape(original, far), Catch::Contains("vertex 0") && Catch::Contains("500 mm"));
  CHECK_THROWS_AS(transfer_shape(original, far, {0}), std::invalid_argument);
  far.point(Vertex(1)) = Point(std::nan(""), 0, 0);
  CHECK_THROWS_AS(transfer_shape(original, far), ContentError);
  for (Vertex v : original.vertices()) CHECK(original.point(v) == before.point(v));
}

TEST_CASE("transfer: a coarse original follows by index where Loop subdivision moved its vertices") {
  const Mesh original = cylinder(0.3, 1, 7, 3);
  Mesh wrinkled = original;
  loop_subdivide(wrinkled, 2);
  note_rest(wrinkled);
  double farthest = 0;
  for (Vertex v : original.vertices())
    farthest = std::max(farthest, std::sqrt(CGAL::squared_distance(original.point(v), wrinkled.point(v))));
  REQUIRE(farthest > 0.02);  // beyond max_distance
  Mesh still = original;
  CHECK(transfer_shape(still, wrinkled).unchanged == original.number_of_vertices());
  for (Vertex v : wrinkled.vertices()) wrinkled.point(v) = posed(wrinkled.point(v));
  Mesh moved = original;
  const TransferReport report = transfer_shape(moved, wrinkled);
  CHECK(report.by_index == original.number_of_vertices());
  CHECK(report.interpolated == 0);
  for (Vertex v : original.vertices())
    CHECK(CGAL::squared_distance(moved.point(v), posed(original.point(v))) < 1e-20);
}

TEST_CASE("transfer: a mesh that no Loop subdivision made is not taken for one") {
  const Mesh original = cylinder(0.3, 1, 7, 3);
  Mesh wrinkled = original;
  loop_subdivide(wrinkled, 1);
  for (Point& p : wrinkled.points()) p = {p.x(), p.y() + 0.001, p.z()};
  note_rest(wrinkled);
  Mesh moved = original;
  CHECK_THROWS_AS(transfer_shape(moved, wrinkled), ContentError);
}
