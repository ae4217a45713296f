// SPDX-License-Identifier: MIT
#include "physics/rest/find_sag.h"

#include <algorithm>
#include <cmath>

namespace furrow::physics {
namespace {

constexpr double largest_sag = 1e6;                    // m: gravity over the least shift
constexpr double first_pull = 1e8, pull_factor = 0.1;  // [1/s^2], [-]
constexpr double nearly_zero = 1e-7;                   // of the weight: the limits in reach are known
constexpr double free_pull = 1;  // [1/s^2]: 10 m of sag; with more, the limits are not in reach yet
constexpr double slowest = 0.9;  // factor at which it gives up
constexpr int first_steps = 60, steps_a_pull = 20;

using Forces = std::vector<Vec3>;

/// Newton's method for the sag w under a load f: the least of  potential(w) - f.w + 1/2 pull w.M w.
/// Without pull its derivative is the net force. Where bounds leave no equilibrium that has no least value;
/// with pull it has, and the net force there, pull M w, is the least in the norm of M^-1 as pull goes to 0.
class Newton {
 public:
  Newton(const Particles& particles, SagSystem& system, std::span<const Vec3> load, const SagOptions& options)
      : particles_(particles), system_(system), load_(load.begin(), load.end()), options_(options) {}

  Sag find() {
    restart();
    best_ = state_;
    const bool descends = minimise(first_steps);
    // Nothing is left but round-off, or the problem is linear and has no solution.
    if (best_.residual <= nearly_zero || (descends && within_limits(state_))) return result();
    lower_pull();
    return result();
  }

 private:
  Sag result() { return {std::move(best_.forces), std::move(best_.net), iterations_, factorisations_}; }
  struct State {
    SagForces forces;
    Forces net, slope;    // load less answer; that less the pull: minus the derivative of the potential
    double potential;     // [J]
    double residual = 0;  // largest net force over weight
    double slack = 0;     // the same of slope
    double size = 0;      // net.M^-1 net
  };
  /// From a pull that hardly lets anything move down to none, each from the last one's end; in smaller steps
  /// where Newton's method does not arrive.
  void lower_pull() {
    pull_ = first_pull;
    restart();
    minimise(steps_a_pull);
    for (double factor = pull_factor; factor < slowest && iterations_ < options_.max_iterations;) {
      const double before = pull_, size = state_.size;
      const Forces w = w_;
      pull_ = before * factor > least_shift() ? before * factor : 0;
      state_ = at(w_);
      minimise(steps_a_pull);
      if (pull_ == 0) return;
      const bool arrived = state_.slack <= 1e-6 * std::max(1.0, state_.residual);
      // Limits in reach, and a tenth of the pull hardly brought anything: that is as near as it comes.
      if (arrived && pull_ <= free_pull && factor <= pull_factor && !within_limits(state_) &&
          state_.size > 0.99 * size)
        return;
      factor = arrived ? std::max(pull_factor, factor * factor) : std::sqrt(factor);
      if (arrived) continue;
      pull_ = before;
      w_ = w;
      state_ = at(w_);
    }
  }
  void restart() {
    w_.assign(load_.size(), Vec3::Zero());
    state_ = at(w_);
  }
  State at(const Forces& w) const {
    State s{{}, load_, {}, 0};
    s.forces = system_.respond(w, s.net);
    s.slope = s.net;
    s.potential = s.forces.potential;
    for (std::size_t i = 0; i < w.size(); ++i) {
      const double inverse = particles_.inv_mass[i];
      if (!(inverse > 0)) continue;
      s.slope[i] -= pull_ / inverse * w[i];
      s.potential += (0.5 * pull_ / inverse * w[i] - load_[i]).dot(w[i]);
      s.residual = std::max(s.residual, s.net[i].norm() * inverse / options_.gravity);
      s.slack = std::max(s.slack, s.slope[i].norm() * inverse / options_.gravity);
      s.size += s.net[i].squaredNorm() * inverse;
    }
    return s;
  }

  /// False if a step found no descent.
  bool minimise(int steps) {
    const double enough = pull_ > 0 ? 1e-8 : options_.tolerance;
    for (int i = 0; i < steps && state_.slack > enough && iterations_ < options_.max_iterations; ++i) {
      ++iterations_;
      if (!step()) return false;
      if (state_.size < best_.size) best_ = state_;
    }
    return true;
  }

  static bool within_limits(const State& s) {
    return std::all_of(s.forces.scale.begin(), s.forces.scale.end(), [](double scale) { return scale == 1; });
  }

  void factorise() {
    const double shift = std::max(pull_, least_shift());
    const bool linear = std::all_of(state_.forces.scale.begin(), state_.forces.scale.end(),
                                    [](double s) { return s == 1 || s == 0; });
    if (linear && state_.forces.scale == factorised_ && shift == factorised_shift_) return;
    system_.factorise(state_.forces, w_, shift);
    ++factorisations_;
    factorised_ = state_.forces.scale;
    factorised_shift_ = shift;
  }

  /// One step downhill; false if there is none, or round-off hides it.
  bool step() {
    factorise();
    Forces move = state_.slope;
    system_.solve(move);
    double slope = 0;
    for (std::size_t i = 0; i < move.size(); ++i) slope -= state_.slope[i].dot(move[i]);
    const double noise = 1e-13 * std::abs(state_.potential);
    for (double share = 1; share > 1e-6; share *= 0.5) {
      Forces w = w_;
      for (std::size_t i = 0; i < w.size(); ++i) w[i] += share * move[i];
      State next = at(w);
      if (next.potential <= state_.potential + 1e-4 * share * slope + noise ||
          next.slack <= 0.5 * state_.slack) {
        w_ = std::move(w);
        state_ = std::move(next);
        return true;
      }
    }
    return false;
  }
  double least_shift() const { return options_.gravity / largest_sag; }

  const Particles& particles_;
  SagSystem& system_;
  const Forces load_;
  const SagOptions options_;
  double pull_ = 0;  // [1/s^2]
  int iterations_ = 0, factorisations_ = 0;
  Forces w_;
  State state_, best_;
  double factorised_shift_ = 0;
  std::vector<double> factorised_;  // scales of the elements in the factor
};

}  // namespace

Sag find_sag(const Particles& particles, SagSystem& system, std::span<const Vec3> load,
             const SagOptions& options) {
  return Newton(particles, system, load, options).find();
}

}  // namespace furrow::physics
