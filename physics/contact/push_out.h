// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include "physics/base/particles.h"
#include "physics/body/collider.h"

namespace furrow::physics {

struct PushOutReport {
  int moved = 0;         ///< points that lay deeper than the level
  double farthest = 0;   ///< longest way that one was moved [m]
  int still_inside = 0;  ///< points that 20 moves did not bring out (a slot narrower than twice the level)
};

/// Moves those points `which` of x that lie deeper than `level` [m] along the body's gradient until they do
/// not. For points that a simulation does not move: pins that start inside a body. Throws
/// std::invalid_argument, nothing moved, for an index out of range or a level that is not finite. Cost: a few
/// queries a point.
PushOutReport push_out(std::span<Vec3> x, std::span<const int> which, const Collider& body, double level = 0);

/// The same of all particles that can move (inv_mass > 0), out to a gap [m]: a start from which a body pushes
/// no harder than it will at rest.
PushOutReport bring_out(Particles& particles, const Collider& body, double gap);

}  // namespace furrow::physics
