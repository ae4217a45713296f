// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/displace_line.h"

#include <catch2/catch.hpp>
#include <limits>
#include <stdexcept>
#include <vector>

#include "tests/test_meshes.h"

using namespace furrow::geometry;

TEST_CASE("displace_line: it moves each vertex by k n and no other") {
  Mesh mesh = furrow::tests::grid(3, 3);
  const Mesh before = mesh;
  const std::vector<Displacement> line = {{Vertex(5), {0, 0, 1}, 0.25}, {Vertex(6), {0.6, 0, 0.8}, -0.5}};
  displace_line(mesh, line);
  CHECK(mesh.point(Vertex(5)) == before.point(Vertex(5)) + Vector(0, 0, 0.25));
  CHECK(mesh.point(Vertex(6)) == before.point(Vertex(6)) + Vector(-0.3, 0, -0.4));
  for (Vertex v : mesh.vertices())
    if (v != Vertex(5) && v != Vertex(6)) CHECK(mesh.point(v) == before.point(v));
}

TEST_CASE("displace_line: it refuses bad input before it touches anything") {
  Mesh mesh = furrow::tests::grid(2, 2);
  const Mesh before = mesh;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Displacement good{Vertex(0), {0, 0, 1}, 1};
  for (const Displacement& bad :
       {Displacement{Vertex(0), {0, 0, 1}, nan}, Displacement{Vertex(0), {0, 0, 2}, 1},
        Displacement{Vertex(0), {nan, 0, 1}, 1}, Displacement{Vertex(99), {0, 0, 1}, 1},
        Displacement{Vertex(), {0, 0, 1}, 1}}) {
    CHECK_THROWS_AS(displace_line(mesh, std::vector{good, bad}), std::invalid_argument);
    for (Vertex v : mesh.vertices()) REQUIRE(mesh.point(v) == before.point(v));
  }
}
