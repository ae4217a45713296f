// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/weld.h"

#include <catch2/catch.hpp>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/measures.h"
#include "geometry/mesh/property_names.h"
#include "tests/test_meshes.h"

using namespace furrow;
using namespace furrow::geometry;

namespace {

/// Every triangle with vertices and a group of its own.
io::MeshFile loose(const Mesh& mesh) {
  io::MeshFile file;
  auto group = ensure_map(file.mesh, attribute::group);
  int number = 0;
  for (const Face f : mesh.faces()) {
    std::vector<Vertex> v;
    for (const Vertex corner : mesh.vertices_around_face(mesh.halfedge(f)))
      v.push_back(file.mesh->add_vertex(mesh.point(corner)));
    group[file.mesh->add_face(v[0], v[1], v[2])] = number++;
  }
  file.mesh->add_vertex({9, 9, 9});
  return file;
}

}  // namespace

TEST_CASE("weld: loose triangles become the mesh that they were cut from, with their groups in order") {
  for (const Mesh& mesh : {tests::grid(5, 4), tests::icosphere(1), tests::cylinder(1, 2, 8, 3)}) {
    const io::MeshFile welded = io::welded(loose(mesh), "t");
    CHECK(welded.mesh->number_of_vertices() == mesh.number_of_vertices());
    CHECK(welded.mesh->number_of_edges() == mesh.number_of_edges());
    CHECK(welded.repairs.merged_vertices == 3 * mesh.number_of_faces() + 1 - mesh.number_of_vertices());
    CHECK(measure(welded.mesh).boundary_loops == measure(mesh).boundary_loops);
    const auto group = find_map(welded.mesh, attribute::group);
    REQUIRE(group);
    int number = 0;
    for (const Face f : welded.mesh->faces()) CHECK((*group)[f] == number++);
  }
}

TEST_CASE("weld: a mesh without two vertices at one place keeps its vertices and faces") {
  io::MeshFile file;
  file.mesh = tests::jittered(6, 6, 0.2, 1);
  const io::MeshFile welded = io::welded(file, "t");
  CHECK(welded.mesh->number_of_vertices() == file.mesh->number_of_vertices());
  for (const Vertex v : file.mesh->vertices()) CHECK(welded.mesh->point(v) == file.mesh->point(v));
  CHECK_FALSE(welded.repairs.any());
}

TEST_CASE("weld: nothing is left of a mesh that is two corners wide") {
  io::MeshFile file;
  const Point p(0, 0, 0);
  const Vertex a = file.mesh->add_vertex(p), b = file.mesh->add_vertex(p),
               c = file.mesh->add_vertex({1, 0, 0});
  file.mesh->add_face(a, b, c);
  CHECK_THROWS_AS(io::welded(file, "t"), ContentError);
}
