// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/close_holes.h"

#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <utility>
#include <vector>

#include "geometry/mesh/face_point.h"
#include "geometry/mesh/parts.h"
#include "geometry/mesh/preconditions.h"

namespace furrow::geometry {

namespace pmp = CGAL::Polygon_mesh_processing;

namespace {

/// Whether faces that close a border would face against those around it: they would lie on them.
bool is_outline(const Mesh& mesh, Halfedge border) {
  Vector across = CGAL::NULL_VECTOR, around = CGAL::NULL_VECTOR;  // twice the area, by Newell; normals
  const Point& from = mesh.point(mesh.source(border));
  for (const Halfedge h : mesh.halfedges_around_face(border)) {
    across =
        across + CGAL::cross_product(mesh.point(mesh.source(h)) - from, mesh.point(mesh.target(h)) - from);
    around = around + normalized(area_normal_of(mesh, mesh.face(mesh.opposite(h))));
  }
  return normalized(across) * normalized(around) < -0.5;
}

}  // namespace

std::vector<BorderLoop> small_holes(const Mesh& mesh, std::size_t most_edges) {
  const Parts parts = find_parts(mesh);
  std::vector<BorderLoop> holes;
  for (BorderLoop& loop : border_loops(mesh)) {
    if (loop.vertices.size() > most_edges || loop.vertices.size() < 3) continue;
    const Halfedge h = mesh.halfedge(loop.vertices[0], loop.vertices[1]);
    if (!h.is_valid() || !mesh.is_border(h) || is_outline(mesh, h)) continue;
    const int part = parts.of_face[mesh.face(mesh.opposite(h)).idx()];
    if (parts.list[std::size_t(part)].faces > loop.vertices.size()) holes.push_back(std::move(loop));
  }
  return holes;
}

std::size_t close_small_holes(Mesh& mesh, std::size_t most_edges) {
  require_triangles(mesh, "close_small_holes");
  std::vector<Halfedge> holes;
  for (const BorderLoop& loop : small_holes(mesh, most_edges))
    holes.push_back(mesh.halfedge(loop.vertices[0], loop.vertices[1]));
  std::size_t closed = 0;
  for (Halfedge h : holes) {
    std::vector<Face> added;
    pmp::triangulate_hole(mesh, h, std::back_inserter(added));
    closed += !added.empty();
  }
  return closed;
}

}  // namespace furrow::geometry
