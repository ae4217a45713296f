// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

#include "physics/rest/clamped_elements.h"

namespace furrow::physics {

struct BalanceOptions {
  double gravity;      ///< what net forces are measured by: m times this is a particle's weight [m/s^2]; > 0
  double tolerance;    ///< largest net force over weight at which it ends [-]; > 0
  int max_iterations;  ///< Newton steps, all in all; >= 1
  /// The system has the factors of a problem that hardly differs, with no limit in reach: they serve as long
  /// as each step with them leaves no more than a tenth.
  bool factors_serve = false;
};
struct Balance {
  ClampedForces forces;   ///< answers of elements and contacts
  std::vector<Vec3> net;  ///< load plus answers on each particle [N]; on pins without meaning
  std::vector<Vec3> way;  ///< the displacement that it is answered to [m]
  int iterations = 0, factorisations = 0;
  bool free_factors = false;  ///< the system has factors of this problem or of the one before, without limits
};

/// Answers of elements and contacts, within their limits, that balance the load [N] on the free particles, or
/// come as near as the limits allow in the norm sum |net|^2 / m. Cost: without limits in reach one
/// factorisation and about three passes; else a factorisation a step, some ten steps where an equilibrium
/// exists and a hundred where none does.
///
/// \details Newton's method with a line search on the convex energy of ClampedElements; its matrix is shifted
/// by the mass times gravity / 10^6 m. If that does not end in 60 steps, again with  1/2 pull w.M w  added,
/// pull from 1e8/s^2 down, each from the last one's end. start: `way` of a problem that hardly differs, from
/// which the first of the two begins, in a few steps then; empty: none.
Balance balance_forces(const Particles& particles, ClampedElements& system, std::span<const Vec3> load,
                       const BalanceOptions& options, std::span<const Vec3> start = {});

}  // namespace furrow::physics
