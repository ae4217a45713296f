// SPDX-License-Identifier: MIT
#include "physics/stable_step.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

#include "physics/spring_forces.h"

namespace furrow::physics {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// In [-1/2, 1/2), a function of its argument only (the mixer splitmix64).
double pseudo_random(std::uint64_t i) {
  std::uint64_t z = (i + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return double((z ^ (z >> 31)) >> 11) * 0x1p-53 - 0.5;
}

/// q -> M^-1/2 K M^-1/2 q.
class Operator {
 public:
  explicit Operator(const Cloth& cloth) : cloth_(cloth), u_(cloth.particles.size()), ku_(u_.size()) {
    for (const double w : cloth.particles.inv_mass) scale_.push_back(std::sqrt(w));
  }
  Index size() const { return Index(3 * u_.size()); }
  const std::vector<double>& scale() const { return scale_; }

  void apply(const Eigen::Ref<const VectorXd>& q, VectorXd& result) {
    for (std::size_t i = 0; i < u_.size(); ++i) u_[i] = scale_[i] * q.segment<3>(Index(3 * i));
    std::fill(ku_.begin(), ku_.end(), Vec3::Zero());
    for (const auto* springs : {&cloth_.structural, &cloth_.bending}) {
      add_spring_stiffness_product(cloth_.particles.x, *springs, u_, Stiffness::positive_part, ku_);
    }
    for (std::size_t i = 0; i < u_.size(); ++i) result.segment<3>(Index(3 * i)) = scale_[i] * ku_[i];
  }

  /// Twice the largest sum of k/m around a particle bounds every eigenvalue: a block of K is at most k, and
  /// the other end's share enters as the geometric mean of both masses.
  double gershgorin() const {
    std::vector<double> row(u_.size(), 0.0);
    for (const auto* springs : {&cloth_.structural, &cloth_.bending}) {
      for (const Spring& s : *springs) {
        const double a = scale_[std::size_t(s.a)], b = scale_[std::size_t(s.b)];
        row[std::size_t(s.a)] += s.stiffness * a * (a + b);
        row[std::size_t(s.b)] += s.stiffness * b * (a + b);
      }
    }
    return row.empty() ? 0 : *std::max_element(row.begin(), row.end());
  }

 private:
  const Cloth& cloth_;
  std::vector<Vec3> u_, ku_;
  std::vector<double> scale_;
};

VectorXd start_vector(const Operator& op, const std::vector<Vec3>& hint) {
  VectorXd q(op.size());
  for (Index i = 0; i < q.size(); ++i)
    q[i] = op.scale()[std::size_t(i / 3)] > 0 ? pseudo_random(std::uint64_t(i)) : 0;
  if (q.norm() > 0) q.normalize();
  if (!hint.empty()) {
    // Some of the random vector stays in, so that a mode that overtook the old one is found.
    q *= 0.3;
    for (std::size_t i = 0; i < hint.size(); ++i) {
      if (op.scale()[i] > 0) q.segment<3>(Index(3 * i)) += hint[i];
    }
    if (q.norm() > 0) q.normalize();
  }
  return q;
}

struct Ritz {
  double theta = 0, residual = 0;
  VectorXd coefficients;
};

Ritz largest_ritz_pair(const std::vector<double>& alpha, const std::vector<double>& beta) {
  const Index m = Index(alpha.size());
  Eigen::SelfAdjointEigenSolver<MatrixXd> solver;
  const VectorXd diagonal = Eigen::Map<const VectorXd>(alpha.data(), m);
  const VectorXd off = Eigen::Map<const VectorXd>(beta.data(), m - 1);
  solver.computeFromTridiagonal(diagonal, off, Eigen::ComputeEigenvectors);
  const VectorXd s = solver.eigenvectors().col(m - 1);
  return {solver.eigenvalues()[m - 1], beta.back() * std::abs(s[m - 1]), s};
}

void check(const Cloth& cloth, const StableStepOptions& options) {
  if (!(options.tolerance > 0 && options.tolerance < 0.5)) {
    throw std::invalid_argument("stable_step: tolerance = " + std::to_string(options.tolerance) +
                                " is not in (0, 0.5)");
  }
  if (options.max_iterations < 1) {
    throw std::invalid_argument("stable_step: max_iterations = " + std::to_string(options.max_iterations));
  }
  if (!options.start.empty() && options.start.size() != cloth.particles.size()) {
    throw std::invalid_argument("stable_step: start has " + std::to_string(options.start.size()) +
                                " entries");
  }
}

}  // namespace

StepLimit stable_step(const Cloth& cloth, const StableStepOptions& options) {
  check(cloth, options);
  Operator op(cloth);
  const double bound = op.gershgorin();
  if (bound == 0) return {std::numeric_limits<double>::infinity(), 0, 0, 0, {}};
  const Index most = std::min<Index>(op.size(), options.max_iterations);
  std::vector<VectorXd> basis{start_vector(op, options.start)};
  std::vector<double> alpha, beta;
  Ritz ritz;
  VectorXd w(op.size());
  while (true) {
    op.apply(basis.back(), w);
    alpha.push_back(basis.back().dot(w));
    for (int round = 0; round < 2; ++round) {
      for (const VectorXd& q : basis) w -= q.dot(w) * q;
    }
    beta.push_back(w.norm());
    const bool exhausted = beta.back() <= 1e-13 * bound || Index(alpha.size()) >= most;
    if (exhausted || alpha.size() % 4 == 0) {
      ritz = largest_ritz_pair(alpha, beta);
      const bool long_enough = alpha.size() >= (options.start.empty() ? 24 : 12);
      if (exhausted || (long_enough && ritz.residual <= options.tolerance * ritz.theta)) break;
    }
    basis.push_back(w / beta.back());
  }
  const double omega = std::sqrt(std::min(ritz.theta + ritz.residual, bound) * (1 + 1e-12));
  VectorXd mode = VectorXd::Zero(op.size());
  for (std::size_t j = 0; j < alpha.size(); ++j) mode += ritz.coefficients[Index(j)] * basis[j];
  StepLimit limit{2 / omega, omega, ritz.residual / ritz.theta, int(alpha.size()), {}};
  for (Index i = 0; i < mode.size(); i += 3) limit.mode.push_back(mode.segment<3>(i));
  return limit;
}

}  // namespace furrow::physics
