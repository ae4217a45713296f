// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Sparse>

#include "physics/cloth/elements.h"

namespace furrow::cases {

/// Which coordinates of which particles move: the unknowns of a linear or nonlinear system. -1: held.
struct Unknowns {
  std::vector<std::array<int, 3>> of;  ///< for each particle and coordinate
  int count = 0;

  /// All coordinates c with axes[c] of the particles with inv_mass > 0.
  Unknowns(const physics::Cloth& cloth, const std::array<bool, 3>& axes);
};

/// The stiffness matrix K [N/m] of the cloth's elements at x over the unknowns; both triangles.
Eigen::SparseMatrix<double> stiffness(const physics::Cloth& cloth, const std::vector<physics::Vec3>& x,
                                      const Unknowns& unknowns,
                                      physics::Stiffness part = physics::Stiffness::exact);
/// Particle masses [kg] over the unknowns.
Eigen::VectorXd masses(const physics::Cloth& cloth, const Unknowns& unknowns);

/// The `count` lowest angular frequencies [1/s]: omega^2 are the eigenvalues of M^-1 K, K positive definite.
/// Dense up to 300 unknowns, else by subspace iteration with a sparse factorisation, to 1e-11 of omega^2.
/// Throws std::invalid_argument if count is not in [1, unknowns]; std::runtime_error if K cannot be
/// factorised or the iteration does not converge.
Eigen::VectorXd lowest_frequencies(const Eigen::SparseMatrix<double>& k, const Eigen::VectorXd& m, int count);

/// The highest [1/s], by Lanczos to 1e-9 of omega^2.
double highest_frequency(const Eigen::SparseMatrix<double>& k, const Eigen::VectorXd& m);

/// Moves the unknowns of the cloth to where elements, weight m g and nothing else balance, by Newton's method
/// with halved steps, until no residual exceeds tolerance [N]. Returns the iterations. Throws
/// std::runtime_error after 200, or if the matrix cannot be factorised.
int find_rest(physics::Cloth& cloth, const Unknowns& unknowns, const physics::Vec3& gravity,
              double tolerance);

}  // namespace furrow::cases
