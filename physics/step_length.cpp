// SPDX-License-Identifier: MIT
#include "physics/step_length.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "physics/stable_step.h"

namespace furrow::physics {
namespace {

constexpr int strain_steps = 200;  // steps between two looks at the strain

}  // namespace

StepLength::StepLength(const Cloth& cloth, const SimulateOptions& options, SimulateState& state)
    : cloth_(cloth), options_(options), state_(state) {
  if (!state.planned) {
    estimate();
    if (options.dt && options.step_rule == StepRule::limited && *options.dt > state.dt_limit) {
      std::ostringstream text;
      text << "simulate: dt = " << *options.dt << " s is above the stability limit of " << state.dt_limit
           << " s";
      throw std::invalid_argument(text.str());
    }
  }
  if (state.planned && state.end == options.seconds && state.dt_longest == longest()) return;
  state.planned = true;
  state.end = options.seconds;
  divide(std::max(state.end - state.time, 0.0));
}

bool StepLength::due() const {
  return state_.step % strain_steps == 0 || state_.step - state_.estimated_at >= options_.limit_steps;
}

void StepLength::advance() {
  --state_.steps_left;
  if (!due() || state_.steps_left == 0 || options_.step_rule == StepRule::forced) return;
  const double strain = strain_statistics(cloth_).max;
  if (state_.step - state_.estimated_at < options_.limit_steps &&
      !(strain > state_.strain_at_estimate + options_.limit_strain))
    return;
  if (!std::isfinite(strain)) return;  // diverged: seen elsewhere
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
  if (!options_.dt) return std::min(options_.dt_factor * state_.dt_limit, options_.dt_max);
  return options_.step_rule == StepRule::forced ? *options_.dt : std::min(*options_.dt, state_.dt_limit);
}

void StepLength::divide(double rest) {
  state_.dt_longest = longest();
  // A hair above, so that 2 s / 0.1 ms is 20000 steps and not 20001.
  state_.steps_left = std::int64_t(std::ceil(rest / state_.dt_longest * (1 - 1e-12)));
  state_.dt = state_.steps_left > 0 ? rest / double(state_.steps_left) : 0;
}

}  // namespace furrow::physics
