// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/shape_body.h"

#include <catch2/catch.hpp>

#include "geometry/figure/repair_body.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/self_intersections.h"
#include "tests/test_meshes.h"
#include "tests/test_paths.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

Mesh mannequin() { return read_plain_obj(source_dir() / "meshes/mannequin.obj"); }

/// By the tape, on the shape as it is now.
BodyMeasures taped(const Mesh& mesh) {
  const Body body = repair_body(mesh);
  return measure_body(body.points, body.triangles);
}

std::vector<Point> points_of(const Mesh& mesh) { return {mesh.points().begin(), mesh.points().end()}; }

}  // namespace

TEST_CASE("shape_body: a mannequin gets a person's measurements, and no part of it crosses another",
          "[release]") {
  for (const BodyMeasures& wanted :
       {BodyMeasures{1.68, 0.92, 0.74, 0.98}, BodyMeasures{1.55, 0.78, 0.58, 0.84},
        BodyMeasures{1.80, 1.15, 1.05, 1.16}}) {
    Mesh mesh = mannequin();
    const std::size_t crossings = count_self_intersections(mesh);
    const ShapeReport report = shape_body(mesh, wanted);
    const BodyMeasures now = taped(mesh);
    CHECK(now.height == Approx(wanted.height).margin(1e-3));
    CHECK(now.chest == Approx(wanted.chest).margin(1e-3));
    CHECK(now.waist == Approx(wanted.waist).margin(1e-3));
    CHECK(now.hip == Approx(wanted.hip).margin(1e-3));
    CHECK(report.farthest <= 1e-3);
    CHECK(count_self_intersections(mesh) == crossings);
  }
}

TEST_CASE("shape_body: the feet stay on the floor, and head and feet follow the height alone") {
  Mesh mesh = mannequin(), scaled = mannequin();
  shape_body(mesh, {1.87, 1.1, 0.9, 1.1});
  shape_body(scaled, {1.87, 0, 0, 0});
  double low = INFINITY, farthest = 0;
  int kept = 0;
  for (const Vertex v : mesh.vertices()) {
    low = std::min(low, mesh.point(v).y());
    const double share = scaled.point(v).y() / 1.87;
    if (share > 0.05 && share < 0.88) continue;
    ++kept;
    farthest = std::max(farthest, std::sqrt((mesh.point(v) - scaled.point(v)).squared_length()));
  }
  CHECK(kept > 100);
  CHECK(farthest < 1e-9);
  double first = INFINITY;
  const Mesh before = mannequin();
  for (const Vertex v : before.vertices()) first = std::min(first, before.point(v).y());
  CHECK(low == Approx(first).margin(1e-12));
}

TEST_CASE("shape_body: what is not asked for keeps its proportion to the height") {
  Mesh mesh = mannequin();
  const BodyMeasures before = taped(mesh);
  shape_body(mesh, {0, 0, 1.1 * before.waist, 0});
  const BodyMeasures now = taped(mesh);
  CHECK(now.height == Approx(before.height));
  CHECK(now.waist == Approx(1.1 * before.waist).margin(1e-3));
  CHECK(now.chest == Approx(before.chest).margin(1e-3));
  CHECK(now.hip == Approx(before.hip).margin(1e-3));
}

TEST_CASE("shape_body: measurements that do not go together are told by how far they are missed") {
  Mesh mesh = mannequin();
  const BodyMeasures before = taped(mesh);
  const ShapeReport report = shape_body(mesh, {0, 0, 1.35 * before.waist, 0});  // wider than chest
  CHECK(report.farthest > 0.005);
  CHECK(report.reached.waist == Approx(taped(mesh).waist));
}

TEST_CASE("shape_body: it refuses what cannot be, and changes nothing") {
  Mesh mesh = mannequin();
  const std::vector<Point> before = points_of(mesh);
  CHECK_THROWS_AS(shape_body(mesh, {}), std::invalid_argument);
  CHECK_THROWS_AS(shape_body(mesh, {3, 0, 0, 0}), std::invalid_argument);
  CHECK_THROWS_AS(shape_body(mesh, {0, 2.5, 0, 0}), std::invalid_argument);
  CHECK_THROWS_AS(shape_body(mesh, {0, NAN, 0, 0}), std::invalid_argument);
  CHECK(points_of(mesh) == before);
  Mesh ball = icosphere(2, 0.2);
  CHECK_THROWS_AS(shape_body(ball, {1.7, 0, 0, 0}), ContentError);
}
