// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include "geometry/mesh/mesh.h"
#include "physics/base/arrays.h"

namespace furrow::bridge {

inline physics::Vec3 to_eigen(const geometry::Point& p) { return {p.x(), p.y(), p.z()}; }
inline geometry::Point to_cgal(const physics::Vec3& x) { return {x.x(), x.y(), x.z()}; }

/// The positions of all vertices [m], by vertex index.
inline std::vector<physics::Vec3> positions_of(const geometry::Mesh& mesh) {
  std::vector<physics::Vec3> x;
  x.reserve(mesh.number_of_vertices());
  for (geometry::Vertex v : mesh.vertices()) x.push_back(to_eigen(mesh.point(v)));
  return x;
}

/// The vertex indices of all faces, in the order of the faces. The mesh is triangles only.
inline std::vector<std::array<int, 3>> triangles_of(const geometry::Mesh& mesh) {
  std::vector<std::array<int, 3>> triangles;
  triangles.reserve(mesh.number_of_faces());
  for (geometry::Face f : mesh.faces()) {
    const geometry::Halfedge h = mesh.halfedge(f);
    triangles.push_back({static_cast<int>(mesh.source(h)), static_cast<int>(mesh.target(h)),
                         static_cast<int>(mesh.target(mesh.next(h)))});
  }
  return triangles;
}

}  // namespace furrow::bridge
