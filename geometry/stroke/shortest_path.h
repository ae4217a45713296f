// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

struct ShortestPath {
  /// On edges and at vertices, in order, from the first vertex to the second [m]; straight between two of
  /// them. Empty if no faces join the two.
  std::vector<Point> points;
  /// A collapsed face (degenerate_faces.h) that a shorter path could cross: `points` is then the shortest
  /// without such faces only, or empty.
  std::optional<Face> degenerate;
};

/// The shortest path over the surface from one vertex to another, exact for the mesh as a polyhedron.
/// Collapsed faces take no part, as no direction is defined on them. Both must be vertices of triangles; cost
/// and source stand at place_path_stroke.h.
ShortestPath shortest_path(const Mesh& mesh, Vertex from, Vertex to);

}  // namespace furrow::geometry
