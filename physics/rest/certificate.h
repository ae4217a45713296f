// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

#include "physics/body/collider.h"
#include "physics/cloth/cloth.h"

namespace furrow::physics {

struct StiffnessWork;

struct CertificateOptions {
  Vec3 gravity{0, -9.81, 0};      ///< [m/s^2]; finite
  double friction = 0.3;          ///< Coulomb coefficient with the body [-]; >= 0
  double gap = 0.003;             ///< a body at most this far (and 1e-5 m) carries [m]; > 0
  int max_steps = 100;            ///< of Lanczos' method; >= 2
  StiffnessWork* work = nullptr;  ///< shared with solves before and after; null: none
  bool count = true;  ///< negative eigenvalues; else they are -1 where there are any, in half of the time
};

struct Certificate {
  double residual = 0;          ///< residual_force() [-]
  int negative_eigenvalues = 0; /**< of K, less than -1e-6/s^2 for K v = lambda M v; -1: some, not known how
                                   many (not counted, or a pivot of the factor is 0) */
  double smallest_eigenvalue = 0;  ///< lambda [1/s^2]; infinity if nothing can move
  double frequency = 0;            ///< sqrt(lambda) / 2 pi [Hz]; 0 if lambda <= 0
  std::vector<Vec3> mode;          ///< its v, one a particle, the longest 1; empty if nothing can move
  int sticking = 0, sliding = 0;   ///< particles on the body that friction holds; that may slide along it

  bool stable() const { return negative_eigenvalues == 0; }
};

/// Whether a cloth at its positions is in equilibrium, and whether that is a stable one: K, the second
/// derivative of the energy of all elements (exact stiffness, loads and weight do not change), is positive
/// definite where particles may move. Then the state is a strict minimum of the energy and small disturbances
/// stay small, without friction or damping. How far it may be disturbed is not said. Cost: one factorisation,
/// more if it is not positive definite; a solve a step. Same input, same bits. Throws std::invalid_argument
/// if an option is out of its range, arrays differ in length, something is not finite, a free particle has no
/// mass, as the elements do, or where one of Cloth::energies has no stiffness.
///
/// \details Contact: a particle within the gap whose best contact force presses (by more than 1e-6 of its
/// weight) is held by a stiffness of 10^6 times K's mean diagonal, along the normal alone, or in all
/// directions where the force lies inside the friction cone. Where it may slide, the body's curvature counts:
/// - N d2psi/dx2 in the tangent plane, N the force, from differences of the field's gradient over the gap (a
/// coarse field blurs that). To hold by friction is no minimum of energy: such a state keeps for disturbances
/// below the friction that is left. The eigenvalue by Lanczos' method on (K + s M)^-1, s = 1e-6/s^2, or, if K
/// is not positive definite, the least s = 1, 4, 16 ... /s^2 with which it is. So motions that cost no
/// energy (a swing about a vertical axis) count as neither.
/// Source: Parlett, The Symmetric Eigenvalue Problem, chapters 13 and 15.
Certificate certify(const Cloth& cloth, const CertificateOptions& options = {},
                    const Collider* collider = nullptr, std::span<const Vec3> loads = {});

}  // namespace furrow::physics
