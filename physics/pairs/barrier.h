// SPDX-License-Identifier: MIT
#pragma once
#include <array>

#include "physics/base/arrays.h"

namespace furrow::physics {

/// What two primitives answer that are nearer to each other than their range.
struct Barrier {
  double energy;     ///< E [J]
  double force;      ///< -E' [N]; > 0
  double stiffness;  ///< E'' [N/m]; > 0
};

/// With u = distance / range: E = 1/2 k range^2 (-ln u - 2 (1 - u) + (1 - u^2) / 2), which is convex,
/// infinite at contact, and 0 with its first two derivatives from u = 1 on. Exact to some 1e-13 next to u =
/// 1, too. distance, range [m] > 0; stiffness k [N/m] > 0. At a distance of 0 all is infinite.
Barrier barrier(double distance, double range, double stiffness);

/// Takes the jump from the forces of two edges that become parallel, where their closest points leap: factor
/// c (2 e - c) / e^2 for c = |e1 x e2|^2 below e = 1e-3 |L1|^2 |L2|^2, else 1.
struct ParallelShare {
  double factor = 1;                          ///< in [0, 1]
  Vec3 first = Vec3::Zero(), second = first;  ///< derivatives by e1 and by e2 [1/m]
};
/// e1, e2: the edges as they lie [m]; lengths: product of their lengths at rest [m^2]; > 0.
ParallelShare parallel_share(const Vec3& e1, const Vec3& e2, double lengths);

}  // namespace furrow::physics
