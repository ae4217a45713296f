// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <functional>
#include <vector>

namespace furrow::physics {

struct LanczosOptions {
  double tolerance;      ///< residual at which it ends, relative to the eigenvalue [-]; > 0
  int most_steps;        ///< >= 1; each costs one product
  int least_steps = 1;   ///< before the residual counts: it can be small before the largest value shows up
  int steps_a_look = 1;  ///< between two looks at the residual; >= 1
  double nothing = 0;    ///< a new direction of at most this norm is rounding [units of A]; >= 0
};

/// An eigenvalue of A and its vector, as far as the steps tell.
struct LanczosResult {
  double value = 0;                    ///< theta [units of A]
  double residual = 0;                 ///< |A y - theta y|: an eigenvalue lies that near
  std::vector<Eigen::VectorXd> basis;  ///< orthonormal, one a step
  Eigen::VectorXd weights;             ///< of the basis in y

  int steps() const { return int(basis.size()); }
  Eigen::VectorXd vector() const;  ///< y, of norm 1
};

/// product = A q; it has the length of q.
using LinearOperator = std::function<void(const Eigen::VectorXd& q, Eigen::VectorXd& product)>;

/// The largest eigenvalue of a symmetric operator A, by Lanczos' method with full reorthogonalisation from a
/// given start. Same input, same bits. Cost: a product and O(n) numbers of memory a step, and O(n steps) for
/// orthogonality. Throws std::invalid_argument if an option is out of its range or the start is zero or not
/// finite. Source: Parlett, The Symmetric Eigenvalue Problem, chapter 13.
LanczosResult largest_eigenvalue(const LinearOperator& a, const Eigen::VectorXd& start,
                                 const LanczosOptions& options);

}  // namespace furrow::physics
