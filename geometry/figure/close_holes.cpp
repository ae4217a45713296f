// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/close_holes.h"

#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <vector>

#include "geometry/mesh/border_loops.h"
#include "geometry/mesh/preconditions.h"

namespace furrow::geometry {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

/// How many faces are joined to each face through edges, itself among them.
std::vector<std::size_t> sizes_of_parts(const Mesh& mesh) {
  std::vector<std::size_t> part(mesh.num_faces(), 0), size;
  std::vector<char> seen(mesh.num_faces(), 0);
  std::vector<Face> open;
  for (Face start : mesh.faces()) {
    if (seen[start.idx()]) continue;
    size.push_back(0);
    open.assign(1, start);
    seen[start.idx()] = 1;
    while (!open.empty()) {
      const Face f = open.back();
      open.pop_back();
      part[f.idx()] = size.size() - 1;
      ++size.back();
      for (Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f))) {
        const Halfedge o = mesh.opposite(h);
        if (mesh.is_border(o) || seen[mesh.face(o).idx()]) continue;
        seen[mesh.face(o).idx()] = 1;
        open.push_back(mesh.face(o));
      }
    }
  }
  for (std::size_t& p : part) p = size.empty() ? 0 : size[p];
  return part;
}

}  // namespace

std::size_t close_small_holes(Mesh& mesh, std::size_t most_edges) {
  require_triangles(mesh, "close_small_holes");
  const std::vector<std::size_t> faces_of_part = sizes_of_parts(mesh);
  std::vector<Halfedge> holes;
  for (const BorderLoop& loop : border_loops(mesh)) {
    if (loop.vertices.size() > most_edges || loop.vertices.size() < 3) continue;
    const Vertex a = loop.vertices[0], b = loop.vertices[1];
    Halfedge h = mesh.halfedge(a, b);
    if (!h.is_valid()) continue;
    if (!mesh.is_border(h)) h = mesh.opposite(h);
    if (!mesh.is_border(h)) continue;
    if (faces_of_part[mesh.face(mesh.opposite(h)).idx()] > loop.vertices.size()) holes.push_back(h);
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
