// SPDX-License-Identifier: MIT
#pragma once
#include "physics/cloth/cloth.h"

namespace furrow::physics {

struct StableStepOptions {
  double tolerance = 0.01;   ///< residual of the largest eigenvalue, relative to it [-]; in (0, 0.5)
  int max_iterations = 400;  ///< >= 1; each costs one product with the stiffness matrix
};

struct StepLimit {
  double dt_limit;   ///< [s]; leapfrog is stable below it; infinity without stiffness
  double omega_max;  ///< upper bound of the highest angular frequency [1/s]
  double residual;   ///< of the largest eigenvalue, relative to it [-]
  int iterations;
};

/// dt_limit = 2 / omega_max,  omega_max^2 the largest eigenvalue of M^-1/2 K M^-1/2 at the present positions,
/// K the stiffness of springs and membrane without the (destabilising) transverse part of what is compressed,
/// that of tension as if strained by tension_margin more than it is, and that of hinges: exact, but for
/// cosine hinges with their largest E''. It bounds the exact K from above.
/// M the masses; what has inv_mass 0 is held. Lanczos with full reorthogonalisation from a fixed
/// pseudo-random start, until the residual r is below the tolerance; then omega_max^2 = theta + r, at most
/// Gershgorin's bound, so that dt_limit errs to the safe side, by at most about half the tolerance.
///
/// Always from the same start: one near an earlier mode converges to that mode although another may have
/// overtaken it.
/// Cost: iterations (32 usually) * (elements + particles * iterations); memory particles * iterations.
/// Throws std::invalid_argument if an option is out of its range.
StepLimit stable_step(const Cloth& cloth, const StableStepOptions& options = {});

}  // namespace furrow::physics
