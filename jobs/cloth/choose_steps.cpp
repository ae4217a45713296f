// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/cloth/choose_steps.h"

#include <algorithm>

#include "jobs/cloth/observation.h"
#include "physics/linear/stable_step.h"

namespace furrow::jobs {
namespace {

using physics::Integrator;

constexpr double leapfrog_is_worth = 2;     // times the time of implicit steps
constexpr double longest_asked = 1.0 / 15;  // s: a longer `dt` is a mistake, which leapfrog's limit tells

double cost_of_second(physics::SimulateOptions options, Integrator integrator, double dt,
                      const physics::Cloth& cloth, bool has_body) {
  options.integrator = integrator;
  return cost_of_step(options, cloth, has_body) / dt;
}

}  // namespace

ChosenSteps choose_steps(const physics::SimulateOptions& options, const physics::Cloth& cloth,
                         bool has_body) {
  const double limit = physics::stable_step(cloth).dt_limit;
  const double longest = std::min(options.dt_factor * limit, options.dt_max);
  const double dt = std::min(options.dt.value_or(longest), longest);
  const double implicit_dt = options.dt.value_or(physics::default_dt(Integrator::implicit));
  ChosenSteps chosen{Integrator::leapfrog, cost_of_second(options, Integrator::leapfrog, dt, cloth, has_body),
                     cost_of_second(options, Integrator::implicit, implicit_dt, cloth, has_body)};
  const bool forced = options.step_rule == physics::StepRule::forced;
  const bool may = options.dt && *options.dt > limit && *options.dt <= longest_asked && !forced;
  const bool implicit = options.dt ? may && chosen.implicit < chosen.leapfrog
                                   : leapfrog_is_worth * chosen.implicit < chosen.leapfrog;
  if (implicit) chosen.integrator = Integrator::implicit;
  return chosen;
}

}  // namespace furrow::jobs
