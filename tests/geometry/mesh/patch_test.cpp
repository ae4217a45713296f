// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/patch.h"

#include <catch2/catch.hpp>

#include "geometry/fold/fold_memory.h"
#include "geometry/insert/mesh_editor.h"
#include "geometry/mesh/sheet.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

/// Half of a sheet, with holes.
std::vector<Face> some_faces(const Mesh& mesh) {
  std::vector<Face> faces;
  for (Face f : mesh.faces())
    if (f.idx() % 7 != 0 && f.idx() > mesh.num_faces() / 3) faces.push_back(f);
  return faces;
}

}  // namespace

TEST_CASE("patch: is a mesh, and a mesh that gets it back as it was keeps all its bits") {
  Mesh mesh = equilateral_sheet(0.5, 0.5, 0.05);
  MeshEditor editor(mesh);
  editor.line()[Vertex(40)] = 3;
  const std::string before = bits_of(mesh);
  const Patch patch = cut_patch(mesh, some_faces(mesh));
  CHECK(patch.mesh.is_valid());
  CHECK(patch.mesh.num_faces() == some_faces(mesh).size());
  put_back(patch, mesh);
  CHECK(bits_of(mesh) == before);
}

TEST_CASE("patch: an edge split and one flipped in it are the same as in the whole") {
  const Mesh given = cylinder(0.2, 0.6, 24, 12);
  Mesh whole = given, pieced = given;
  MeshEditor in_whole(whole), in_pieced(pieced);
  std::vector<Face> faces;
  for (Face f : given.faces())
    if (f.idx() >= 40 && f.idx() < 400) faces.push_back(f);
  Patch patch = cut_patch(pieced, faces);
  MeshEditor in_patch(patch.mesh);
  const std::vector<bool> rim = patch.rim(pieced);
  int edited = 0;
  for (std::size_t i = 60; i < patch.edges.size() && edited < 2; ++i) {
    const Edge e = patch.edges[i], there(static_cast<Edge::size_type>(i));
    const Halfedge h = whole.halfedge(e);
    bool inside = !whole.is_border(e);
    for (Vertex v : {whole.source(h), whole.target(h), whole.target(whole.next(h)),
                     whole.target(whole.next(whole.opposite(h)))}) {
      const auto at = std::lower_bound(patch.vertices.begin(), patch.vertices.end(), v);
      inside =
          inside && at != patch.vertices.end() && *at == v && !rim[std::size_t(at - patch.vertices.begin())];
    }
    if (!inside) continue;
    const Halfedge same(2 * there.idx() + h.idx() % 2);
    if (edited++ == 0)
      in_whole.split_edge(h, 0.3), in_patch.split_edge(same, 0.3);
    else
      in_whole.flip_edge(e), in_patch.flip_edge(there);
    i += 90;
  }
  REQUIRE(edited == 2);
  put_back(patch, pieced);
  CHECK(pieced.is_valid());
  CHECK(pieced.num_vertices() == given.num_vertices() + 1);
  CHECK(bits_of(pieced) == bits_of(whole));
}
