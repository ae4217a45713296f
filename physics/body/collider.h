// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include "physics/base/arrays.h"

namespace furrow::physics {

struct SignedDistance {
  double value;   ///< [m]; negative inside the body
  Vec3 gradient;  ///< [-]; points away from the body, length about 1 (not normalised)
};

/// A body that cloth collides with. Queries are const and may come from several threads.
class Collider {
 public:
  virtual ~Collider() = default;
  virtual SignedDistance at(const Vec3& x) const = 0;
  /// at() with a gradient that is continuous where that of a sampled body jumps, for callers that look for a
  /// minimum: at a kink of the distance no step would succeed. The value differs from that of at() by less
  /// than 1e-5 m. The default, for bodies without kinks, is at().
  virtual SignedDistance smooth_at(const Vec3& x) const { return at(x); }
};

/// What a particle knows of the body's field, so that it need not be asked while it is far.
struct ContactMemory {
  Vec3 x;        ///< where the field was asked last, in the body's frame [m]
  double level;  ///< its value there [m]; NaN: never asked
};

/// What friction remembers of a particle from step to step, in the body's frame.
struct ContactAnchor {
  Vec3 anchor = Vec3::Zero();  ///< to where friction pulls back [m]
  Vec3 plane = Vec3::Zero();   ///< normal that it was set with: friction is across it
  double limit = -1;           ///< of friction [N]; < 0: no anchor
  bool slides = false;         ///< dragged its anchor last time
  double nearer = 0;           ///< than the gap, by so much: it began there, or has no more room [m]; >= 0
  bool operator==(const ContactAnchor&) const = default;
};

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
