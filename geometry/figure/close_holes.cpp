// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/close_holes.h"

#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <vector>

#include "geometry/mesh/border_loops.h"
#include "geometry/mesh/parts.h"
#include "geometry/mesh/preconditions.h"

namespace furrow::geometry {

namespace pmp = CGAL::Polygon_mesh_processing;

std::size_t close_small_holes(Mesh& mesh, std::size_t most_edges) {
  require_triangles(mesh, "close_small_holes");
  const Parts parts = find_parts(mesh);
  std::vector<Halfedge> holes;
  for (const BorderLoop& loop : border_loops(mesh)) {
    if (loop.vertices.size() > most_edges || loop.vertices.size() < 3) continue;
    const Vertex a = loop.vertices[0], b = loop.vertices[1];
    Halfedge h = mesh.halfedge(a, b);
    if (!h.is_valid()) continue;
    if (!mesh.is_border(h)) h = mesh.opposite(h);
    if (!mesh.is_border(h)) continue;
    const int part = parts.of_face[mesh.face(mesh.opposite(h)).idx()];
    if (parts.list[std::size_t(part)].faces > loop.vertices.size()) holes.push_back(h);
  }
  std::size_t closed = 0;
  for (Halfedge h : holes) {
    std::vector<Face> added;
    pmp::triangulate_hole(mesh, h, std::back_inserter(added));
    closed += !added.empty();
  }
  return closed;
}

}  // namespace furrow::geometry
