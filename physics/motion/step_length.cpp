// SPDX-License-Identifier: MIT
#include "physics/motion/step_length.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/base/cancel_scope.h"
#include "physics/base/require.h"
#include "physics/linear/stable_step.h"
#include "physics/packed/dashpots.h"

namespace furrow::physics {
namespace {

constexpr int strain_steps = 200;  // steps between two looks at the strain
constexpr double most_steps = 1e12;

}  // namespace

StepLength::StepLength(const Cloth& cloth, const SimulateOptions& options, SimulateState& state)
    : cloth_(cloth), options_(options), state_(state) {
  const std::uint64_t present = fingerprint(cloth);
  if (state.cloth != present) state.planned = false;
  if (options.integrator == Integrator::rk4) {
    const PackedCloth packed = pack(cloth);
    fastest_decay_ = fastest_decay(packed, dashpots(packed, options.spring_damping)) + options.air_drag;
  }
  const bool has_limit = !is_unconditionally_stable(options.integrator);
  if (!state.planned) state.dt_limit = 0;
  if (has_limit && state.dt_limit == 0) {
    state.planned = false;
    estimate();
  }
  const bool as_planned = state.planned && state.dt_longest == longest();
  if (as_planned && state.end == options.seconds) return;
  const double most = limit(state.dt_limit);
  if (options.dt && options.step_rule == StepRule::limited && *options.dt > most && !as_planned)
    refuse("simulate", "dt = ", *options.dt, " s is above the stability limit of ", most,
           " s; take a shorter step, or leave dt out");
  state.planned = true;
  state.cloth = present;
  state.end = options.seconds;
  divide(std::max(state.end - state.time, 0.0));
}

double StepLength::limit(double leapfrog) const {
  if (is_unconditionally_stable(options_.integrator)) return std::numeric_limits<double>::infinity();
  if (options_.integrator != Integrator::rk4) return leapfrog;
  const double oscillation = rk4_limit / 2 * leapfrog;
  return fastest_decay_ > 0 ? std::min(oscillation, rk4_damped_limit / fastest_decay_) : oscillation;
}

bool StepLength::due() const {
  if (is_unconditionally_stable(options_.integrator)) return false;
  return state_.step % strain_steps == 0 || state_.step - state_.estimated_at >= options_.limit_steps;
}

void StepLength::advance() {
  --state_.steps_left;
  if (!due() || state_.steps_left == 0 || options_.step_rule == StepRule::forced) return;
  const double strain = strain_statistics(cloth_).max;
  if (state_.step - state_.estimated_at < options_.limit_steps &&
      !(strain > state_.strain_at_estimate + options_.limit_strain))
    return;
  if (!std::isfinite(strain)) return;             // diverged: seen elsewhere
  const CancelScope whole([] { return false; });  // a run that is resumed would lack this estimate
  estimate();
  divide(double(state_.steps_left) * state_.dt);
}

void StepLength::estimate() {
  state_.dt_limit = stable_step(cloth_).dt_limit;
  state_.strain_at_estimate = strain_statistics(cloth_).max;
  state_.estimated_at = state_.step;
  state_.totals.dt_limit_smallest = std::min(state_.totals.dt_limit_smallest, state_.dt_limit);
  ++state_.totals.limit_estimates;
}

double StepLength::longest() const {
  if (solves_contact(options_.integrator)) return options_.dt.value_or(default_dt(options_.integrator));
  if (is_unconditionally_stable(options_.integrator))
    return options_.dt.value_or(std::min(default_dt(options_.integrator), options_.dt_max));
  const double most = limit(state_.dt_limit);
  if (!options_.dt) return std::min(options_.dt_factor * most, options_.dt_max);
  return options_.step_rule == StepRule::forced ? *options_.dt : std::min(*options_.dt, most);
}

void StepLength::divide(double rest) {
  state_.dt_longest = longest();
  if (!(rest / state_.dt_longest < most_steps))
    refuse("simulate", "steps of ", state_.dt_longest, " s for ", rest,
           " s are too many; shorten the time, or choose a longer dt ", "or a softer or heavier cloth");
  // A hair above, so that 2 s / 0.1 ms is 20000 steps and not 20001.
  state_.steps_left = std::int64_t(std::ceil(rest / state_.dt_longest * (1 - 1e-12)));
  state_.dt = state_.steps_left > 0 ? rest / double(state_.steps_left) : 0;
}

}  // namespace furrow::physics
