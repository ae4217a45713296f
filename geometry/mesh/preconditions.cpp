// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/preconditions.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "geometry/mesh/errors.h"

namespace furrow::geometry {

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
