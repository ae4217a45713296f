// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/mesh_fwd.h"

#include <catch2/catch.hpp>
#include <set>
#include <utility>
#include <vector>

#include "geometry/mesh/mesh.h"
#include "geometry/mesh/property_names.h"
#include "tests/test_meshes.h"

using namespace furrow;
using namespace furrow::geometry;

TEST_CASE("mesh_fwd: an owned mesh is a value: a copy has its maps, and changes alone") {
  Owned<Mesh> first = tests::grid(3, 2);
  ensure_map(first, attribute::line)[*first->vertices().begin()] = 7;
  Owned<Mesh> second = first;
  CHECK(find_map(second, attribute::line).value()[*second->vertices().begin()] == 7);
  second->point(*second->vertices().begin()) = {9, 9, 9};
  CHECK(first->point(*first->vertices().begin()) != Point(9, 9, 9));
  first = second;
  CHECK(first->point(*first->vertices().begin()) == Point(9, 9, 9));
  const Mesh& same = first;
  CHECK(&same == &*first);
}

TEST_CASE("mesh_fwd: what an owned mesh was moved from, or began as, is an empty mesh") {
  Owned<Mesh> first = tests::grid(3, 2), second = std::move(first);
  CHECK(std::as_const(first)->number_of_vertices() == 0);
  first->add_vertex({1, 2, 3});
  CHECK(first->number_of_vertices() == 1);
  CHECK(second->number_of_vertices() == 12);
  const Mesh taken = std::move(second);
  CHECK(taken.number_of_vertices() == 12);
  Owned<Mesh> never;
  CHECK(Owned<Mesh>(never)->is_empty());
}

TEST_CASE("mesh_fwd: an index is the vertex that it was made of, and an unset one none") {
  const Mesh mesh = tests::grid(3, 2);
  std::vector<Index<Vertex>> indices(mesh.vertices().begin(), mesh.vertices().end());
  for (Vertex v : indices) CHECK((indices[v.idx()] == v && v == indices[v.idx()]));
  CHECK((indices[0] < indices[1] && indices[0] != indices[1] && indices[1].idx() == 1));
  CHECK(std::set<Vertex>(indices.begin(), indices.end()).size() == mesh.number_of_vertices());
  CHECK(Index<Vertex>() == Mesh::null_vertex());
  CHECK(Index<Edge>() == Mesh::null_edge());
}

TEST_CASE("mesh_fwd: coordinates are the bits of the point, or of the vector, that they were made of") {
  const Point p(0.1, -1e-300, 3);
  const Coordinates<Point> stored = p;
  CHECK((stored == p && p == stored && Point(stored) == p));
  CHECK((stored.x() == p.x() && stored.y() == p.y() && stored[2] == p.z()));
  CHECK(Coordinates<Vector>(1, 2, 3) == Vector(1, 2, 3));
  CHECK(Coordinates<Point>() == Point(0, 0, 0));
}
