// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include "physics/base/arrays.h"

namespace furrow::physics {

/// On which side of an inner layer the vertices of an outer one lie.
struct LayerOrder {
  int compared = 0;  ///< vertices near it, and neither at its border nor level with it
  int outside = 0;   ///< of them, on its outer side
};

/// outer: positions [m]; inner: a layer's faces, which look outwards, or inwards if it is turned. Vertices
/// within `reach` [m] of a face are compared by the face's smoothed normal there; those that lie at less than
/// some 12 degrees to the surface, seen from its nearest point, are not. Throws std::invalid_argument as
/// check_body(). Cost: some 1 us a vertex.
LayerOrder layer_order(std::span<const Vec3> outer, const TriangleMesh& inner, bool turned, double reach);

}  // namespace furrow::physics
