// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/insert/mesh_editor.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <set>

#include "geometry/mesh/property_names.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

const PropertyName<Edge, double>* const own[] = {&attribute::stiffness, &attribute::bending_stiffness,
                                                 &attribute::hinge_stiffness, &attribute::tension,
                                                 &attribute::rest_angle};

/// A grid with a value of its own for every element.
Mesh set_mesh() {
  Mesh mesh = grid(4, 4);
  for (const auto* name : own)
    for (Edge e : mesh.edges()) ensure_map(mesh, *name)[e] = 0.01 + 0.001 * e.idx();
  for (Halfedge h : mesh.halfedges())
    ensure_map(mesh, attribute::triangle_rest_length)[h] = 1 + 0.001 * h.idx();
  return mesh;
}

/// After `edit`: unset are exactly the edges of changed faces and the half-edges in them; all others have
/// their bits.
void check_unset(const std::function<void(MeshEditor&)>& edit) {
  Mesh mesh = set_mesh();
  MeshEditor editor(mesh);
  edit(editor);
  std::set<Edge> edges;
  std::set<Halfedge> halfedges;
  for (Face f : editor.changed())
    for (Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f)))
      edges.insert(mesh.edge(h)), halfedges.insert(h);
  REQUIRE(edges.size() >= 5);
  for (const auto* name : own) {
    INFO(name->name);
    const auto map = *find_map(mesh, *name);
    for (Edge e : mesh.edges()) {
      if (edges.count(e))
        CHECK(std::isnan(map[e]));
      else
        CHECK(map[e] == 0.01 + 0.001 * e.idx());
    }
  }
  const auto rest = *find_map(mesh, attribute::triangle_rest_length);
  for (Halfedge h : mesh.halfedges()) {
    if (mesh.is_border(h)) continue;
    if (halfedges.count(h))
      CHECK(std::isnan(rest[h]));
    else
      CHECK(rest[h] == 1 + 0.001 * h.idx());
  }
}

}  // namespace

TEST_CASE(
    "mesh_editor: a split face takes stiffness, rest angles and rest lengths of its own from what it "
    "changes") {
  check_unset([](MeshEditor& e) { e.split_face({Face(9), {0.3, 0.3, 0.4}}); });
}

TEST_CASE(
    "mesh_editor: a split edge takes stiffness, rest angles and rest lengths of its own from what it "
    "changes") {
  check_unset([](MeshEditor& e) { e.split_edge(e.mesh().halfedge(Vertex(6), Vertex(12)), 0.4); });
}

TEST_CASE(
    "mesh_editor: a flipped edge takes stiffness, rest angles and rest lengths of its own from what it "
    "changes") {
  check_unset([](MeshEditor& e) { e.flip_edge(*e.edge_between(Vertex(6), Vertex(12))); });
}

TEST_CASE("mesh_editor: a diagonal that is flipped or split is none") {
  for (const bool flip : {true, false}) {
    Mesh mesh = set_mesh();
    auto diagonal = ensure_map(mesh, attribute::diagonal);
    for (Edge e : mesh.edges()) diagonal[e] = true;
    MeshEditor editor(mesh);
    const std::size_t before = mesh.number_of_edges();
    if (flip)
      editor.flip_edge(*editor.edge_between(Vertex(6), Vertex(12)));
    else
      editor.split_edge(mesh.halfedge(Vertex(6), Vertex(12)), 0.4);
    std::size_t marked = 0;
    for (Edge e : mesh.edges()) marked += diagonal[e];
    CHECK(marked == before - 1);
  }
}
