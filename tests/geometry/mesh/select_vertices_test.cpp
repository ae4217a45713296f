// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/select_vertices.h"

#include <catch2/catch.hpp>

#include "geometry/mesh/property_names.h"

using namespace furrow::geometry;

namespace {

Mesh square() {
  Mesh mesh;
  const Vertex a = mesh.add_vertex(Point(0, 0, 0)), b = mesh.add_vertex(Point(1, 0, 0));
  const Vertex c = mesh.add_vertex(Point(1, 1, 0)), d = mesh.add_vertex(Point(0, 1, 0));
  mesh.add_face(a, b, c);
  mesh.add_face(a, c, d);
  return mesh;
}

}  // namespace

TEST_CASE("vertices_in_box: it takes the corners in any order, borders included") {
  const Mesh mesh = square();
  CHECK(vertices_in_box(mesh, {2, 1, 1}, {0.5, 0, -1}) == std::vector<Vertex>{Vertex(1), Vertex(2)});
  CHECK(vertices_in_box(mesh, {5, 5, 5}, {6, 6, 6}).empty());
}

TEST_CASE("vertices_of_group: it takes each vertex of the group's faces once, and none without groups") {
  Mesh mesh = square();
  CHECK(vertices_of_group(mesh, 0).empty());
  auto group = ensure_map(mesh, attribute::group);
  group[Face(1)] = 3;
  CHECK(vertices_of_group(mesh, 3) == std::vector<Vertex>{Vertex(0), Vertex(2), Vertex(3)});
}
