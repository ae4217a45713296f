// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "bridge/arrays/gather.h"
#include "geometry/figure/repair_body.h"
#include "geometry/mesh/mesh.h"

using namespace furrow;
using geometry::Mesh;
using geometry::Point;
using geometry::Vertex;

TEST_CASE("body: a tetrahedron without a face becomes a closed body that faces outwards") {
  Mesh mesh;
  const Vertex a = mesh.add_vertex(Point(0, 0, 0)), b = mesh.add_vertex(Point(1, 0, 0));
  const Vertex c = mesh.add_vertex(Point(0, 1, 0)), d = mesh.add_vertex(Point(0, 0, 1));
  mesh.add_face(a, b, c);  // inside out: its normal is +z, towards d
  mesh.add_face(a, d, b);
  mesh.add_face(a, c, d);
  const geometry::Body repaired = geometry::repair_body(mesh);
  CHECK(repaired.report.filled_holes == 1);
  const physics::TriangleMesh body = bridge::to_triangle_mesh(repaired);
  REQUIRE(body.triangles.size() == 4);
  double volume = 0;
  for (const auto& t : body.triangles) {
    const auto& x = body.vertices;
    volume += x[t[0]].dot(x[t[1]].cross(x[t[2]])) / 6;
  }
  CHECK(volume == Approx(1.0 / 6));
}
