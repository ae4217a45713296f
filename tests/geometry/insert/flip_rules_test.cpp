// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/insert/flip_rules.h"

#include <catch2/catch.hpp>

#include "geometry/insert/restore_delaunay.h"
#include "tests/geometry/insert/insertion_meshes.h"

namespace furrow::tests {

using namespace geometry;

TEST_CASE("flip_rules: a flip is refused at the border, at line edges, beside a valence-3 vertex") {
  Mesh mesh = regular_sheet(6, 0.1);
  MeshEditor editor(mesh);
  const Vertex inner = nearest_vertex(mesh, Point(0.5, 0.5, 0));
  const Halfedge spoke = mesh.halfedge(inner);
  const Face face = mesh.face(spoke);
  CHECK_FALSE(refusal_of_flip(editor, mesh.edge(spoke), {}).has_value());
  editor.line_edge()[mesh.edge(spoke)] = true;
  CHECK(refusal_of_flip(editor, mesh.edge(spoke), {}) == Refusal::line_edge);
  for (Edge e : mesh.edges()) {
    if (mesh.is_border(e)) CHECK(refusal_of_flip(editor, e, {}) == Refusal::border);
  }
  const Vertex centre = editor.split_face({face, {0.3, 0.3, 0.4}});
  REQUIRE(mesh.degree(centre) == 3);
  InsertionOptions paper;
  paper.rule = InsertionRule::paper;
  for (Halfedge h : mesh.halfedges_around_target(mesh.halfedge(centre))) {
    CHECK(refusal_of_flip(editor, mesh.edge(h), {}) == Refusal::duplicate_edge);
    CHECK(refusal_of_flip(editor, mesh.edge(h), paper) == Refusal::duplicate_edge);
  }
}

TEST_CASE("flip_rules: a border corner keeps two edges") {
  Mesh mesh;
  for (const Point& p :
       {Point(0, 0, 0), Point(1, 0, 0), Point(1.2, 1.1, 0), Point(0, 1, 0), Point(-1, 0.5, 0)}) {
    mesh.add_vertex(p);
  }
  mesh.add_face(Vertex(0), Vertex(1), Vertex(2));
  mesh.add_face(Vertex(0), Vertex(2), Vertex(3));
  mesh.add_face(Vertex(0), Vertex(3), Vertex(4));
  MeshEditor editor(mesh);
  // Vertex 2 has three edges and may give one.
  const Edge diagonal = mesh.edge(mesh.halfedge(Vertex(0), Vertex(2)));
  REQUIRE_FALSE(refusal_of_flip(editor, diagonal, {}).has_value());
  editor.flip_edge(diagonal);
  CHECK(mesh.degree(Vertex(2)) == 2);
  CHECK(mesh.halfedge(Vertex(1), Vertex(3)).is_valid());
}

TEST_CASE("flip_rules: Delaunay flips leave no edge that could be flipped, and spare line edges") {
  Mesh mesh = regular_sheet(12, 0.45, 5);
  MeshEditor editor(mesh);
  std::vector<Face> faces(mesh.faces().begin(), mesh.faces().end());
  for (std::size_t i = 0; i < faces.size(); i += 2) editor.split_face({faces[i], {0.25, 0.25, 0.5}});
  const Edge kept = mesh.edge(mesh.halfedge(faces[101]));
  editor.line_edge()[kept] = true;
  const auto ends = std::pair(mesh.vertex(kept, 0), mesh.vertex(kept, 1));
  CHECK(restore_delaunay(editor, {}) > 0);
  std::size_t left = 0;
  for (Edge e : mesh.edges()) {
    if (mesh.is_border(e) || editor.changed().count(mesh.face(mesh.halfedge(e, 0))) == 0) continue;
    left += cotangent_sum(mesh, editor.rest(), e) < -1e-7 && !refusal_of_flip(editor, e, {});
  }
  CHECK(left == 0);
  CHECK(mesh.halfedge(ends.first, ends.second).is_valid());
  CHECK(restore_delaunay(editor, {}) == 0);
}

}  // namespace furrow::tests
