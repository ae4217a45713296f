// SPDX-License-Identifier: MIT
#pragma once
#include <functional>

#include "physics/particles.h"

namespace furrow::physics {

/// Which part of the second derivative of an energy counts.
enum class Stiffness {
  exact,         ///< the Hessian itself; indefinite where springs are compressed or hinges bent
  positive_part  ///< semidefinite: springs without the transverse part of compressed ones; see each element
};

/// Takes what one element adds to the block of the stiffness matrix K [N/m] in the rows of particle i and the
/// columns of particle j. K is the second derivative of the energy, so forces change by -K u.
using BlockSink = std::function<void(int i, int j, const Mat3& block)>;

}  // namespace furrow::physics
