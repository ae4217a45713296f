// SPDX-License-Identifier: MIT
#pragma once
#include "physics/cloth/cloth.h"

namespace furrow::physics {

struct StaticOptions {
  Vec3 gravity{0, -9.81, 0};  ///< [m/s^2]; finite
  double tolerance = 1e-6;    ///< largest net force on a free particle, relative to its weight [-]; > 0
  int max_iterations = 1000;  ///< Newton steps for each load; >= 1
  int load_steps = 1;         ///< gravity grows to its value in so many equal steps; >= 1
};

struct StaticReport {
  int iterations = 0;      ///< Newton steps, all loads
  int factorisations = 0;  ///< of the stiffness matrix, with those that found it indefinite
  double residual = 0;     ///< largest net force relative to weight [-], as residual_force() without a body
  bool converged = false;  ///< residual <= tolerance
  bool stable = false;     ///< the exact stiffness is positive definite where it ended
};

/// Moves the free particles (inv_mass > 0) to rest, where  E(x) - sum m g.x  is stationary, E the energy of
/// all elements (elements.h); the others stay as they lie. Velocities become 0. No bodies, air or friction.
/// Weight is m |gravity|, with 9.81 m/s^2 where gravity is 0.
///
/// Newton's method from cloth.particles.x with the exact stiffness K; where K is not positive definite
/// K + shift I with the least shift of a geometric sequence that is, so that every step goes downhill (the
/// sequence goes by the size of K's mean diagonal, or by largest force / extent where that is more, so that a
/// cloth without stiffness at its start finds its way, too); the step is halved until the energy falls enough
/// (Armijo, 1e-4). It ends when the tolerance is met, after max_iterations, or when round-off hides every
/// descent (the residual tells; try a larger tolerance). A start within a plane of symmetry stays there, even
/// where the equilibrium is not stable: disturb it, or ask report.stable. Many states of rest may exist; the
/// one found depends on the start.
///
/// Cost: a sparse factorisation, O(n^1.5) for a sheet of n particles, each step; one pass over the elements
/// each energy. The same input gives the same bits.
/// Throws std::invalid_argument, nothing changed, if an option is out of its range, arrays differ in length,
/// a free particle's mass is not > 0, a position is not finite, or as the elements do.
/// Source: Nocedal and Wright, Numerical Optimization, 2nd ed., sections 3.1 and 3.4.
StaticReport find_static_equilibrium(Cloth& cloth, const StaticOptions& options = {});

}  // namespace furrow::physics
