// SPDX-License-Identifier: MIT
#pragma once
#include <array>

#include "physics/pairs/pair_curvature.h"
#include "physics/pairs/pair_mesh.h"

namespace furrow::physics {

/// A pair that is nearer than its range, as it lies: what it answers.
struct ActivePair {
  PairKey key;
  std::array<int, 4> vertices;
  std::array<double, 4> weights;  ///< of the closest points (PairDistance)
  std::array<Vec3, 4> force;      ///< on its vertices [N]
  Vec3 normal;                    ///< from its second primitive to its first
  double distance;                ///< [m]
  double energy, stiffness;       ///< [J], [N/m]
  double push = 0;                ///< along the normal [N]; >= 0
  double range = 0;               ///< at which its primitives begin to push [m]; > 0
  PairCurvature curvature = {};   ///< of its distance
};

}  // namespace furrow::physics
