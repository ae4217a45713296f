// SPDX-License-Identifier: MIT
#include "physics/linear/lanczos.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "physics/base/cancel_scope.h"
#include "physics/base/require.h"

namespace furrow::physics {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

void check(const VectorXd& start, const LanczosOptions& o) {
  const auto check = [](const char* option, double value, bool good, const char* range) {
    require("largest_eigenvalue", option, value, good, range);
  };
  check("tolerance", o.tolerance, o.tolerance > 0, "> 0");
  check("most_steps", o.most_steps, o.most_steps >= 1, ">= 1");
  check("steps_a_look", o.steps_a_look, o.steps_a_look >= 1, ">= 1");
  if (o.nothing < 0) check("nothing", o.nothing, false, ">= 0");  // an operator may be not finite
  const double norm = start.norm();
  check("norm of the start", norm, norm > 0, "> 0");
}

/// The largest eigenvalue of the tridiagonal matrix with diagonal alpha and beside it beta, whose last number
/// leads out of the basis.
void find_ritz(const std::vector<double>& alpha, const std::vector<double>& beta, LanczosResult& result) {
  const Index m = Index(alpha.size());
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  const VectorXd diagonal = Eigen::Map<const VectorXd>(alpha.data(), m);
  const VectorXd off = Eigen::Map<const VectorXd>(beta.data(), m - 1);
  solver.computeFromTridiagonal(diagonal, off, Eigen::ComputeEigenvectors);
  result.value = solver.eigenvalues()[m - 1];
  result.weights = solver.eigenvectors().col(m - 1);
  result.residual = beta.back() * std::abs(result.weights[m - 1]);
}

}  // namespace

VectorXd LanczosResult::vector() const {
  VectorXd y = VectorXd::Zero(basis.empty() ? 0 : basis[0].size());
  for (std::size_t j = 0; j < basis.size(); ++j) y += weights[Index(j)] * basis[j];
  return y;
}

LanczosResult largest_eigenvalue(const LinearOperator& a, const VectorXd& start, const LanczosOptions& o) {
  check(start, o);
  LanczosResult result;
  std::vector<VectorXd>& basis = result.basis;
  basis.push_back(start.normalized());
  std::vector<double> alpha, beta;
  VectorXd w(start.size());
  while (true) {
    throw_if_cancelled("largest_eigenvalue");
    a(basis.back(), w);
    alpha.push_back(basis.back().dot(w));
    for (int round = 0; round < 2; ++round) {
      for (const VectorXd& q : basis) w -= q.dot(w) * q;
    }
    beta.push_back(w.norm());
    const int steps = int(alpha.size());
    if (!std::isfinite(alpha.back() + beta.back())) {  // of such numbers the solver would find no end
      result.weights = VectorXd::Zero(steps);
      result.value = result.residual = std::numeric_limits<double>::quiet_NaN();
      return result;
    }
    const bool last = beta.back() <= o.nothing || steps >= o.most_steps;
    if (last || (steps >= o.least_steps && steps % o.steps_a_look == 0)) {
      find_ritz(alpha, beta, result);
      if (last || result.residual <= o.tolerance * result.value) return result;
    }
    basis.push_back(w / beta.back());
  }
}

}  // namespace furrow::physics
