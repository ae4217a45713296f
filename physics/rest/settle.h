// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <limits>

#include "physics/body/collider.h"
#include "physics/cloth/cloth.h"

namespace furrow::physics {

struct SettleOptions {
  Vec3 gravity{0, -9.81, 0};  ///< [m/s^2]; finite
  double friction = 0.3;      ///< Coulomb coefficient with the body [-]; >= 0
  double gap = 0.003;         ///< distance from the body at which it begins to push [m]; > 0
  /// How far the cloth may lie inside the gap at rest [m]; >= 1e-7. By default 0.1 mm in the mean, 1 mm where
  /// most presses on it. With a smaller value tight cloth keeps its energy; 1e-6 takes about twice as long
  /// where tolerance is 1e-3.
  double contact_depth = std::numeric_limits<double>::infinity();
  double tolerance = 1e-3;   ///< residual_force() at which it ends [-]; > 0
  int max_iterations = 200;  ///< >= 0
  /// No vertex moves farther in a step [m]; > 0: less than half the thickness of any limb.
  double longest_move = 0.02;
  int threads = 1;  ///< that share the work; >= 1; the result is the same for any number
};

struct SettleProgress {
  int iteration;
  double residual;  ///< [-]
};
/// Called before each iteration and at the end; the cloth holds the state of then and must stay as it is.
/// false: stop here.
using SettleObserver = std::function<bool(const SettleProgress&)>;

struct SettleReport {
  int iterations = 0, factorisations = 0;
  int followers = 0;       ///< steps with the factors of the step before
  double residual = 0;     ///< residual_force() at the end [-]
  bool converged = false;  ///< residual <= tolerance
  bool stopped = false;    ///< by the observer
  int touching = 0;        ///< particles that the body carries
  double deepest = 0;      ///< of them, inside the gap [m]
};

/// Moves the free particles to rest on a body (null: none), from cloth.particles.x: to a state in which
/// elements, weight and contact forces within the friction cone balance. Velocities become 0. The way there
/// counts for nothing. Where friction acts there are many such states, and the start chooses; a start that
/// lies deeper in the body than the gap should be brought out first (bring_out()).
/// Cost: a factorisation or two an iteration, O(n^1.5) for n particles of a sheet; some 10 to 30 iterations.
/// Same input, same bits. Throws std::invalid_argument, nothing changed, if an option is out of its range,
/// arrays differ in length, a position is not finite, a free particle has no mass, or as the elements do.
///
/// \details Newton's method on the energy of elements, weight and AnchoredContact. Where the Hessian is not
/// positive definite, as much of its clamped part (Stiffness) is added as makes it so, and m / tau^2, tau
/// from 0.03 s up while steps succeed (pseudo-transient continuation). A step is halved until the energy
/// falls (Armijo, 1e-4). Near rest, up to fifteen quasi-Newton steps (LimitedMemory) follow each Newton step
/// with its factors. Limits of friction follow the push within a step. One of Cloth::energies without
/// stiffness counts in forces and energies alone: the same rest by more iterations, or none where it is the
/// stiffest of all. It looks for balance alone: from a start within a plane of symmetry it may end in a
/// saddle, which certify() tells. Source: Nocedal and Wright, Numerical Optimization, 2nd ed., 3.1; Kelley
/// and Keyes 1998, Convergence analysis of pseudo-transient continuation, SIAM J. Numer. Anal. 35(2).
SettleReport settle(Cloth& cloth, const Collider* collider, const SettleOptions& options,
                    const SettleObserver& observer = {});

}  // namespace furrow::physics
