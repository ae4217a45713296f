// SPDX-License-Identifier: MIT
#pragma once
#include <functional>

#include "physics/particles.h"

namespace furrow::physics {

/// Which part of the second derivative of an energy counts: the Hessian itself, which is indefinite where
/// springs are compressed or hinges bent; a semidefinite part of it (springs without the transverse part of
/// compressed ones; see each element); or what lies between.
struct Stiffness {
  double clamped;  ///< share of the way from the Hessian to the semidefinite part [-]; in [0, 1]
  static const Stiffness exact, positive_part;
  bool operator==(const Stiffness&) const = default;
};
inline constexpr Stiffness Stiffness::exact{0}, Stiffness::positive_part{1};

/// Takes what one element adds to the block of the stiffness matrix K [N/m] in the rows of particle i and the
/// columns of particle j. K is the second derivative of the energy, so forces change by -K u.
using BlockSink = std::function<void(int i, int j, const Mat3& block)>;

}  // namespace furrow::physics
