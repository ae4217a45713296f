// SPDX-License-Identifier: MIT
#pragma once
#include "physics/base/particles.h"

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

}  // namespace furrow::physics
