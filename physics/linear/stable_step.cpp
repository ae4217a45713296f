// SPDX-License-Identifier: MIT
#include "physics/linear/stable_step.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "physics/base/require.h"
#include "physics/cloth/spring_forces.h"
#include "physics/linear/lanczos.h"
#include "physics/packed/element_product.h"

namespace furrow::physics {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// A residual can be small before the largest eigenvalue has shown up at all, but hardly after so many steps.
constexpr int least_iterations = 32;
constexpr double difference_error = 1e-7;  // of a product by differences of forces

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
  explicit Operator(const Cloth& cloth)
      : cloth_(cloth), elements_(cloth), u_(cloth.particles.size()), ku_(u_.size()) {
    for (const double w : cloth.particles.inv_mass) scale_.push_back(std::sqrt(w));
  }
  Index size() const { return Index(3 * u_.size()); }
  bool is_bounded() const { return elements_.is_bounded(); }
  const std::vector<double>& scale() const { return scale_; }

  void apply(const Eigen::Ref<const VectorXd>& q, VectorXd& result) {
    for (std::size_t i = 0; i < u_.size(); ++i) u_[i] = scale_[i] * q.segment<3>(Index(3 * i));
    std::fill(ku_.begin(), ku_.end(), Vec3::Zero());
    for (const auto* springs : {&cloth_.structural, &cloth_.bending}) {
      add_spring_stiffness_product(cloth_.particles.x, *springs, u_, Stiffness::positive_part, ku_);
    }
    elements_.add(u_, ku_);
    for (std::size_t i = 0; i < u_.size(); ++i) result.segment<3>(Index(3 * i)) = scale_[i] * ku_[i];
  }

  /// Twice the largest sum of k/m around a particle bounds every eigenvalue of springs: a block of K is at
  /// most k, and the other end's share enters as the geometric mean of both masses. Elements: sums of blocks'
  /// norms.
  double gershgorin() const {
    std::vector<double> row(u_.size(), 0.0);
    for (const auto* springs : {&cloth_.structural, &cloth_.bending}) {
      for (const Spring& s : *springs) {
        const double a = scale_[std::size_t(s.a)], b = scale_[std::size_t(s.b)];
        row[std::size_t(s.a)] += s.stiffness * a * (a + b);
        row[std::size_t(s.b)] += s.stiffness * b * (a + b);
      }
    }
    elements_.add_row_sums(scale_, row);
    return row.empty() ? 0 : *std::max_element(row.begin(), row.end());
  }

 private:
  const Cloth& cloth_;
  ElementProduct elements_;
  std::vector<Vec3> u_, ku_;
  std::vector<double> scale_;
};

VectorXd start_vector(const Operator& op) {
  VectorXd q(op.size());
  for (Index i = 0; i < q.size(); ++i) {
    q[i] = op.scale()[std::size_t(i / 3)] > 0 ? pseudo_random(std::uint64_t(i)) : 0;
  }
  return q;
}

/// |A q| / |q| of the start: a scale where no bound is known; 0 if nothing moves or resists.
double growth(Operator& op) {
  const VectorXd q = start_vector(op);
  VectorXd product(q.size());
  op.apply(q, product);
  return q.norm() > 0 ? product.norm() / q.norm() : 0;
}

void check(const StableStepOptions& o) {
  require("stable_step", "tolerance", o.tolerance, o.tolerance > 0 && o.tolerance < 0.5, "in (0, 0.5)");
  require("stable_step", "max_iterations", o.max_iterations, o.max_iterations >= 1, ">= 1");
}

}  // namespace

StepLimit stable_step(const Cloth& cloth, const StableStepOptions& options) {
  check(options);
  Operator op(cloth);
  const double infinity = std::numeric_limits<double>::infinity(), sums = op.gershgorin();
  const double bound = op.is_bounded() ? sums : infinity;
  const double nothing = op.is_bounded() ? 1e-13 * sums : difference_error * growth(op);
  if (nothing == 0) return {infinity, 0, 0, 0};
  const LanczosResult ritz = largest_eigenvalue(
      [&](const VectorXd& q, VectorXd& product) { op.apply(q, product); }, start_vector(op),
      {.tolerance = options.tolerance,
       .most_steps = int(std::min<Index>(op.size(), options.max_iterations)),
       .least_steps = least_iterations,
       .steps_a_look = 4,
       .nothing = nothing});
  const double largest = std::min(ritz.value + ritz.residual, bound) * (1 + 1e-12);
  if (!(largest > 0)) return {std::numeric_limits<double>::infinity(), 0, 0, ritz.steps()};
  const double omega = std::sqrt(largest);
  return {2 / omega, omega, ritz.value > 0 ? ritz.residual / ritz.value : 0, ritz.steps()};
}

}  // namespace furrow::physics
