// SPDX-License-Identifier: MIT
#pragma once
#include "physics/particles.h"

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
};

}  // namespace furrow::physics
