// SPDX-License-Identifier: MIT
#include "physics/rest/static_equilibrium.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "physics/cloth/elements.h"
#include "physics/linear/free_stiffness.h"

namespace furrow::physics {
namespace {

constexpr double first_shift = 1e-12;  // relative to K's mean diagonal
constexpr double largest_shift = 1e3;  // a step this short changes nothing
constexpr int most_idle = 3;
constexpr double standard_gravity = 9.81;

using Positions = std::vector<Vec3>;

void check(const Cloth& cloth, const StaticOptions& o) {
  const auto fail = [](const std::string& what) {
    throw std::invalid_argument("find_static_equilibrium: " + what);
  };
  if (!o.gravity.allFinite()) fail("gravity is not finite");
  if (!(o.tolerance > 0)) fail("tolerance = " + std::to_string(o.tolerance) + " is not > 0");
  if (o.max_iterations < 1) fail("max_iterations = " + std::to_string(o.max_iterations) + " is not >= 1");
  if (o.load_steps < 1) fail("load_steps = " + std::to_string(o.load_steps) + " is not >= 1");
  const Particles& p = cloth.particles;
  if (p.v.size() != p.size() || p.mass.size() != p.size() || p.inv_mass.size() != p.size()) {
    fail("the particles' arrays differ in length");
  }
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!p.x[i].allFinite()) fail("position " + std::to_string(i) + " is not finite");
    if (p.inv_mass[i] > 0 && !(p.mass[i] > 0 && std::isfinite(p.mass[i]))) {
      fail("mass of free particle " + std::to_string(i) + " = " + std::to_string(p.mass[i]) + " is not > 0");
    }
  }
}

/// One load: a cloth under one gravity.
class Newton {
 public:
  Newton(Cloth& cloth, FreeStiffness& stiffness, StaticReport& report, const StaticOptions& options)
      : cloth_(cloth), stiffness_(stiffness), report_(report), options_(options) {
    const double g = options.gravity.norm();
    weight_per_mass_ = g > 0 ? g : standard_gravity;
    Eigen::AlignedBox3d box;
    for (const Vec3& x : cloth.particles.x) box.extend(x);
    if (!cloth.particles.x.empty()) extent_ = box.diagonal().norm();
  }

  void run(const Vec3& gravity) {
    gravity_ = gravity;
    shift_ = 0;
    double best = std::numeric_limits<double>::infinity();
    int idle = 0;  // steps whose gain drowned in round-off without half the residual
    for (int i = 0;; ++i) {
      find_net_force();
      report_.converged = report_.residual <= options_.tolerance;
      if (report_.residual < 0.5 * best) idle = 0;
      best = std::min(best, report_.residual);
      if (report_.converged || i == options_.max_iterations || idle > most_idle || !step()) return;
      ++report_.iterations;
      if (-slope_ < before_.noise) ++idle;
    }
  }

  bool positive_definite() {
    stiffness_.assemble(cloth_, cloth_.particles.x, Stiffness::exact);
    ++report_.factorisations;
    return stiffness_.factorise() == 0;
  }

 private:
  struct Energy {
    double value, noise;  // noise: what round-off may do to it
  };
  Energy energy(const Positions& x) const {
    const double elastic = potential_energy(cloth_, x);
    double weight = 0, size = elastic;
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (!(cloth_.particles.inv_mass[i] > 0)) continue;
      const double e = cloth_.particles.mass[i] * gravity_.dot(x[i]);
      weight += e;
      size += std::abs(e);
    }
    return {elastic - weight, 64 * std::numeric_limits<double>::epsilon() * size};
  }

  void find_net_force() {
    const Particles& p = cloth_.particles;
    force_.assign(p.size(), Vec3::Zero());
    add_forces(cloth_, p.x, force_);
    report_.residual = 0;
    double largest = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (!(p.inv_mass[i] > 0)) {
        force_[i].setZero();
        continue;
      }
      force_[i] += p.mass[i] * gravity_;
      report_.residual = std::max(report_.residual, force_[i].norm() / (p.mass[i] * weight_per_mass_));
      largest = std::max(largest, force_[i].norm());
    }
    if (extent_ > 0) least_scale_ = largest / extent_;
  }

  /// Solves (K + shift I) move = force with a shift that makes it positive definite; false if there is none.
  bool find_move() {
    const double scale = std::max(std::abs(stiffness_.mean_diagonal()), least_scale_);
    for (; shift_ <= largest_shift; shift_ = std::max(first_shift, 8 * shift_)) {
      ++report_.factorisations;
      if (stiffness_.factorise(shift_ * scale) != 0) continue;
      move_ = force_;
      stiffness_.solve(move_);
      return true;
    }
    return false;
  }

  /// One Newton step downhill; false if there is none.
  bool step() {
    stiffness_.assemble(cloth_, cloth_.particles.x, Stiffness::exact);
    before_ = energy(cloth_.particles.x);
    for (; find_move(); shift_ = std::max(first_shift, 16 * shift_)) {
      slope_ = 0;
      for (std::size_t i = 0; i < move_.size(); ++i) slope_ -= force_[i].dot(move_[i]);
      for (double share = 1; share > 1e-3; share *= 0.5) {
        Positions x = cloth_.particles.x;
        for (std::size_t i = 0; i < x.size(); ++i) x[i] += share * move_[i];
        const double value = energy(x).value;
        if (!(value <= before_.value + 1e-4 * share * slope_ + before_.noise)) continue;
        const bool moved = x != cloth_.particles.x;
        cloth_.particles.x = std::move(x);
        shift_ = share == 1 ? (shift_ > first_shift ? 0.1 * shift_ : 0) : shift_;
        return moved;
      }
    }
    return false;
  }

  Cloth& cloth_;
  FreeStiffness& stiffness_;
  StaticReport& report_;
  const StaticOptions& options_;
  double weight_per_mass_ = standard_gravity;
  Vec3 gravity_ = Vec3::Zero();
  double extent_ = 0;       // of the cloth [m]
  double least_scale_ = 0;  // of shifts [N/m]: tension has no stiffness at rest
  double shift_ = 0;        // relative to K's mean diagonal; carried from step to step
  Energy before_{};         // of the last step
  double slope_ = 0;        // of the energy along the last move [J]; < 0
  Positions force_, move_;
};

}  // namespace

StaticReport find_static_equilibrium(Cloth& cloth, const StaticOptions& options) {
  check(cloth, options);
  FreeStiffness stiffness(cloth);
  StaticReport report;
  Newton newton(cloth, stiffness, report, options);
  for (int k = 1; k <= options.load_steps; ++k) newton.run(double(k) / options.load_steps * options.gravity);
  report.stable = newton.positive_definite();
  std::fill(cloth.particles.v.begin(), cloth.particles.v.end(), Vec3::Zero());
  return report;
}

}  // namespace furrow::physics
