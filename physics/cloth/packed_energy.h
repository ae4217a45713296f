// SPDX-License-Identifier: MIT
#pragma once
#include "physics/base/vec4.h"

namespace furrow::physics {

/// One of Cloth::energies (Energy::packed()) for callers that keep positions and forces as vectors of four,
/// each particle at a place of its own, and ask often.
class PackedEnergy {
 public:
  virtual ~PackedEnergy() = default;

  /// E [J]; adds the forces -dE/dx [N], unless `force` is null. One entry a place, w is 0.
  virtual double add_forces(const Vec4* x, Vec4* force) const = 0;
};

}  // namespace furrow::physics
