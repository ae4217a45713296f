// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <span>

#include "physics/base/arrays.h"
#include "physics/base/float4.h"

namespace furrow::physics {

/// A box along axes of its own.
struct OrientedBox {
  Eigen::Matrix3d axes;  ///< orthonormal rows
  Vec3 middle, half;     ///< along these axes [m]
};

/// Around points, along the principal axes of their spread: nearly the least box of a bundle of needles, or
/// of a sector of a fan, which fill next to nothing of a box along x, y and z. O(points); needs one at least.
OrientedBox fit_oriented_box(std::span<const Vec3> points);

/// Half the surface [m2].
inline double half_surface(const Vec3& half) {
  return 4 * (half[0] * half[1] + half[1] * half[2] + half[2] * half[0]);
}

/// Four boxes in float. One that was not set lies everywhere: nothing is away from it.
struct OrientedBoxes {
  Float4 axes[3][3], middle[3], half[3];

  OrientedBoxes();
  void set(int lane, const OrientedBox& box);
};

/// Squares of lower bounds of the distances from p to the four boxes; `slack` [m] is above the rounding of
/// coordinates as large as p's and the boxes'.
inline Float4 oriented_distances(const OrientedBoxes& boxes, const Float4* p, float slack) {
  Float4 sum = splat(0);
  for (int k = 0; k < 3; ++k) {
    const Float4* axis = boxes.axes[k];
    const Float4 along = axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2];
    const Float4 d = positive_part(absolute(along - boxes.middle[k]) - boxes.half[k] - splat(slack));
    sum += d * d;
  }
  return sum;
}

}  // namespace furrow::physics
