// SPDX-License-Identifier: MIT
#include "physics/rest/balance_forces.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "physics/base/cancel_scope.h"

namespace furrow::physics {
namespace {

constexpr double longest_way = 1e6;                    // m: gravity over the least shift
constexpr double first_pull = 1e8, pull_factor = 0.1;  // [1/s^2], [-]
constexpr double nearly_zero = 1e-7;                   // of the weight: the limits in reach are known
constexpr double rounded = 0.5;  // share of what was nearly zero, of which round-off leaves more
constexpr double free_pull = 1;  // [1/s^2]: 10 m of way; with more, the limits are not in reach yet
constexpr double served = 0.1;   // share of what was left, that factors of another problem may leave
constexpr double slowest = 0.9;  // factor at which it gives up
constexpr int first_steps = 60, steps_a_pull = 20;

using Forces = std::vector<Vec3>;

/// A displacement, and what is answered to it.
struct State {
  Forces w;     // [m]
  double pull;  // [1/s^2]
  ClampedForces forces;
  Forces net, slope;    // load less answer; that less the pull: minus the derivative of the potential
  double potential;     // [J]
  double residual = 0;  // largest net force over weight
  double slack = 0;     // the same of slope
  double size = 0;      // net.M^-1 net
};
/// The least net forces so far.
struct Best {
  Balance balance;
  double residual, size;  // of State
};
struct Minimum {
  State state;
  bool descends;  // false: a step found no descent
};

bool within_limits(const State& s) {
  return std::all_of(s.forces.scale.begin(), s.forces.scale.end(), [](double scale) { return scale == 1; });
}

/// Newton's method for the displacement w under a load f: the least of
///   potential(w) - f.w + 1/2 pull w.M w.
/// Without pull its derivative is the net force. Where bounds leave no equilibrium that has no least value;
/// with pull it has, and the net force there, pull M w, is the least in the norm of M^-1 as pull goes to 0.
class Newton {
 public:
  Newton(const Particles& particles, ClampedElements& system, std::span<const Vec3> load,
         const BalanceOptions& options)
      : particles_(particles), system_(system), load_(load), options_(options) {}

  Balance find(Forces from) {
    State start = at(std::move(from), 0);
    Best best{{start.forces, start.net, start.w}, start.residual, start.size};
    if (options_.factors_serve) start = go_on_with_factors(std::move(start), best);
    const Minimum found = minimise(std::move(start), first_steps, best);
    // Nothing is left but round-off, or the problem is linear and has no solution.
    const bool done = best.residual <= nearly_zero || (found.descends && within_limits(found.state));
    if (!done) lower_pull(best);
    best.balance.free_factors = has_free_factors();
    return std::move(best.balance);
  }

 private:
  /// From a pull that hardly lets anything move down to none, each from the last one's end; in smaller steps
  /// where Newton's method does not arrive.
  void lower_pull(Best& best) {
    State last = minimise(at(Forces(load_.size(), Vec3::Zero()), first_pull), steps_a_pull, best).state;
    for (double factor = pull_factor;
         factor < slowest && best.balance.iterations < options_.max_iterations;) {
      const double lower = last.pull * factor;
      State now = minimise(at(last.w, lower > least_shift() ? lower : 0), steps_a_pull, best).state;
      if (now.pull == 0) return;
      const bool arrived = now.slack <= 1e-6 * std::max(1.0, now.residual);
      // Limits in reach, and a tenth of the pull hardly brought anything: that is as near as it comes.
      if (arrived && now.pull <= free_pull && factor <= pull_factor && !within_limits(now) &&
          now.size > 0.99 * last.size)
        return;
      factor = arrived ? std::max(pull_factor, factor * factor) : std::sqrt(factor);
      if (arrived) last = std::move(now);
    }
  }

  State at(Forces w, double pull) const {
    State s{std::move(w), pull, {}, Forces(load_.begin(), load_.end()), {}, 0};
    s.forces = system_.respond(s.w, s.net);
    s.slope = s.net;
    s.potential = s.forces.potential;
    for (std::size_t i = 0; i < s.w.size(); ++i) {
      const double inverse = particles_.inv_mass[i];
      if (!(inverse > 0)) continue;
      s.slope[i] -= pull / inverse * s.w[i];
      s.potential += (0.5 * pull / inverse * s.w[i] - load_[i]).dot(s.w[i]);
      s.residual = std::max(s.residual, s.net[i].norm() * inverse / options_.gravity);
      s.slack = std::max(s.slack, s.slope[i].norm() * inverse / options_.gravity);
      s.size += s.net[i].squaredNorm() * inverse;
    }
    return s;
  }

  /// With those that the system has from before.
  State go_on_with_factors(State state, Best& best) {
    factorised_.assign(state.forces.scale.size(), 1);
    factorised_shift_ = least_shift();
    while (state.slack > options_.tolerance && within_limits(state)) {
      throw_if_cancelled("prestress");
      ++best.balance.iterations;
      std::optional<State> next = step(state);
      if (!next || next->slack > served * state.slack) break;
      state = std::move(*next);
      note(state, best);
    }
    if (state.slack > options_.tolerance) factorised_.clear();
    return state;
  }

  void note(const State& state, Best& best) const {
    if (!(state.size < best.size)) return;
    best.balance.forces = state.forces;
    best.balance.net = state.net;
    best.balance.way = state.w;
    best.residual = state.residual;
    best.size = state.size;
  }

  bool has_free_factors() const {
    return factorised_shift_ == least_shift() && !factorised_.empty() &&
           std::all_of(factorised_.begin(), factorised_.end(), [](double scale) { return scale == 1; });
  }

  Minimum minimise(State state, int steps, Best& best) {
    const double enough = state.pull > 0 ? 1e-8 : options_.tolerance;
    Balance& balance = best.balance;
    for (int i = 0; i < steps && state.slack > enough && balance.iterations < options_.max_iterations; ++i) {
      throw_if_cancelled("prestress");
      ++balance.iterations;
      balance.factorisations += factorise(state) ? 1 : 0;
      std::optional<State> next = step(state);
      if (!next) return {std::move(state), false};
      const bool is_rounded = state.slack <= nearly_zero && next->slack > rounded * state.slack;
      state = std::move(*next);
      note(state, best);
      if (is_rounded) break;
    }
    return {std::move(state), true};
  }

  /// False if the system has these factors.
  bool factorise(const State& state) {
    const double shift = std::max(state.pull, least_shift());
    const std::vector<double>& scale = state.forces.scale;
    const bool linear = std::all_of(scale.begin(), scale.end(), [](double s) { return s == 1 || s == 0; });
    if (linear && scale == factorised_ && shift == factorised_shift_) return false;
    system_.factorise(state.forces, state.w, shift);
    factorised_ = scale;
    factorised_shift_ = shift;
    return true;
  }

  /// One step downhill with the system's factors; none if round-off hides it.
  std::optional<State> step(const State& from) const {
    Forces move = from.slope;
    system_.solve(move);
    double slope = 0;
    for (std::size_t i = 0; i < move.size(); ++i) slope -= from.slope[i].dot(move[i]);
    const double noise = 1e-13 * std::abs(from.potential);
    for (double share = 1; share > 1e-6; share *= 0.5) {
      throw_if_cancelled("prestress");
      Forces w = from.w;
      for (std::size_t i = 0; i < w.size(); ++i) w[i] += share * move[i];
      State next = at(std::move(w), from.pull);
      if (next.potential <= from.potential + 1e-4 * share * slope + noise || next.slack <= 0.5 * from.slack)
        return next;
    }
    return std::nullopt;
  }

  double least_shift() const { return options_.gravity / longest_way; }

  const Particles& particles_;
  ClampedElements& system_;
  const std::span<const Vec3> load_;
  const BalanceOptions& options_;
  double factorised_shift_ = 0;     // of the system's factors,
  std::vector<double> factorised_;  // and their scales of the elements
};

}  // namespace

Balance balance_forces(const Particles& particles, ClampedElements& system, std::span<const Vec3> load,
                       const BalanceOptions& options, std::span<const Vec3> start) {
  Forces from(start.begin(), start.end());
  if (start.empty()) from.assign(load.size(), Vec3::Zero());
  return Newton(particles, system, load, options).find(std::move(from));
}

}  // namespace furrow::physics
