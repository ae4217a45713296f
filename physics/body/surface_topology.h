// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <vector>

#include "physics/base/arrays.h"
#include "physics/body/closest_on_triangle.h"

namespace furrow::physics {

/// How the triangles of a soup hang together once vertices at the same position are one.
struct SurfaceTopology {
  static constexpr int none = -1;  ///< in neighbours: no single, equally oriented triangle across this edge

  int vertices = 0;                            ///< distinct positions
  std::vector<std::array<int, 3>> triangles;   ///< indices of distinct positions
  std::vector<std::array<int, 3>> neighbours;  ///< across the edges 01, 12, 20
  std::vector<Vec3> normals;                   ///< unit; zero where a triangle has no area
  std::vector<Vec3> corner_normals;            ///< a distinct position: sum of angle times normal
  std::vector<char> joined;                    ///< a triangle: has three neighbours, no pinched corner
  std::vector<char> sound;                     ///< and an area
  int border_edges = 0;                        ///< edges of one triangle
  int irregular_edges = 0;                     ///< edges of more than two, or of two that run the same way
  bool closed = false;  ///< every edge is run through as often forwards as backwards: w is a whole number
};

/// Cost O(T log T). Triangles with two corners at one place are left aside: not sound, and no edge counts.
SurfaceTopology surface_topology(const TriangleMesh& mesh);

/// The topology of the same triangles with their vertices elsewhere: what surface_topology(mesh) gives. Cost
/// O(T), a third of that, while the same vertices are at one place.
void move_vertices(SurfaceTopology& topology, const TriangleMesh& mesh);

/// The direction that tells the sides of the surface apart at a feature (Baerentzen & Aanaes 2005): the face
/// normal, the sum of the two face normals on an edge, the angle-weighted sum at a corner. Not normalised.
Vec3 pseudonormal(const SurfaceTopology& topology, int triangle, Feature feature);

}  // namespace furrow::physics
