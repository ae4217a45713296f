// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/preconditions.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"

namespace furrow::geometry {
namespace {

template <class Index>
bool is_there(const Mesh& mesh, Index i) {
  return mesh.has_valid_index(i) && !mesh.is_removed(i);
}

/// What next() leads to leads back, around the same face; what the half-edge names is there.
bool is_sound(const Mesh& mesh, Halfedge h) {
  const Halfedge next = mesh.next(h);
  return is_there(mesh, next) && mesh.prev(next) == h && mesh.face(next) == mesh.face(h) &&
         is_there(mesh, mesh.target(h)) && mesh.halfedge(mesh.target(h)) != Mesh::null_halfedge() &&
         mesh.target(mesh.opposite(next)) == mesh.target(h) &&
         (mesh.is_border(h) || is_there(mesh, mesh.face(h)));
}
bool is_sound(const Mesh& mesh, Vertex v) {
  const Halfedge h = mesh.halfedge(v);
  return h == Mesh::null_halfedge() || (is_there(mesh, h) && mesh.target(h) == v);
}
bool is_sound(const Mesh& mesh, Face f) {
  return is_there(mesh, mesh.halfedge(f)) && mesh.face(mesh.halfedge(f)) == f;
}

template <class Range>
void require_sound(const Mesh& mesh, const Range& all, const char* what, const char* operation) {
  for (const auto i : all)
    if (!is_sound(mesh, i))
      refuse(operation, what + (" " + std::to_string(i.idx())) +
                            " of the mesh names neighbours that are not there, or do not name it; " +
                            "build the mesh by add_face()");
}

void require_few_lines(const Mesh& mesh, const char* operation) {
  const auto line = find_map(mesh, attribute::line);
  if (!line) return;
  for (const Vertex v : mesh.vertices())
    if ((*line)[v] >= most_lines)
      throw ContentError(std::string(operation) + ": vertex " + std::to_string(v.idx()) + " is of line " +
                         std::to_string((*line)[v]) + "; number lines from 0");
}

}  // namespace

void require_structure(const Mesh& mesh, const char* operation) {
  require_sound(mesh, mesh.halfedges(), "half-edge", operation);
  require_sound(mesh, mesh.vertices(), "vertex", operation);
  require_sound(mesh, mesh.faces(), "face", operation);
}

void check_mesh(const Mesh& mesh, const char* operation) {
  require_structure(mesh, operation);
  if (mesh.has_garbage())
    refuse(operation, "the mesh has removed elements; call its collect_garbage() first");
  require_finite(mesh, operation);
  require_triangles(mesh, operation);
  require_few_lines(mesh, operation);
}

void refuse(const char* operation, const std::string& what) {
  throw std::invalid_argument(operation + (": " + what));
}

void require_finite(const Mesh& mesh, const char* operation) {
  for (Vertex v : mesh.vertices()) {
    const Point& p = mesh.point(v);
    if (std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z())) continue;
    throw ContentError(std::string(operation) + ": the position of vertex " + std::to_string(v.idx()) +
                       " is not finite; repair the mesh first");
  }
}

void require_triangles(const Mesh& mesh, const char* operation) {
  for (Face f : mesh.faces()) {
    const Halfedge h = mesh.halfedge(f);
    if (mesh.next(mesh.next(mesh.next(h))) == h && mesh.next(mesh.next(h)) != h) continue;
    throw ContentError(std::string(operation) + ": face " + std::to_string(f.idx()) + " has " +
                       std::to_string(mesh.degree(f)) + " corners; triangulate the mesh first");
  }
}

void require_vertices(const Mesh& mesh, std::span<const Vertex> vertices, const char* operation) {
  for (Vertex v : vertices) {
    if (v.is_valid() && v.idx() < mesh.num_vertices() && !mesh.is_removed(v)) continue;
    refuse(operation, "the mesh has no vertex " + (v.is_valid() ? std::to_string(v.idx()) : "(null)"));
  }
}

}  // namespace furrow::geometry
