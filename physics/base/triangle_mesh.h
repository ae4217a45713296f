// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <vector>

#include "physics/base/particles.h"

namespace furrow::physics {

/// A triangle soup as plain arrays; faces are counter-clockwise seen from outside. Vertices may be doubled.
struct TriangleMesh {
  std::vector<Vec3> vertices;                 ///< [m]
  std::vector<std::array<int, 3>> triangles;  ///< vertex indices
};

/// Throws std::invalid_argument, with `who` and the place in the message, when there is no triangle, an index
/// is out of range, a used coordinate is not finite or beyond 1e9 m, or no triangle has an area. Cost O(V +
/// T).
void check_body(const TriangleMesh& mesh, const char* who);

/// Length of the diagonal of the bounding box of the used vertices [m].
double bounding_diagonal(const TriangleMesh& mesh);

}  // namespace furrow::physics
