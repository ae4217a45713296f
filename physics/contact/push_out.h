// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include "physics/body/collider.h"

namespace furrow::physics {

struct PushOutReport {
  int moved = 0;         ///< points that lay deeper than the level
  double farthest = 0;   ///< longest way that one was moved [m]
  int still_inside = 0;  ///< points that 20 moves did not bring out (a slot narrower than twice the level)
};

/// Moves the points `which` of x that lie deeper than `level` [m] along the body's gradient until they do
/// not. For what the simulation does not move: pins that start inside a body. Throws std::invalid_argument,
/// nothing moved, for an index out of range or a level that is not finite. Cost: a few queries a point.
PushOutReport push_out(std::span<Vec3> x, std::span<const int> which, const Collider& body, double level = 0);

}  // namespace furrow::physics
