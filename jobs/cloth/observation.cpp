// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/cloth/observation.h"

#include <algorithm>
#include <array>

#include "jobs/cloth/cost_table.h"
#include "physics/linear/stable_step.h"
#include "physics/plate/plate_bending.h"

namespace furrow::jobs {
namespace {

constexpr double longest_stretch = 0.2;      // of processor time, between two looks [s]
constexpr double between_shown = 1.0 / 240;  // of motion [s]
constexpr std::array steps_between{100, 50, 20, 10, 5, 2, 1};

/// Or a little longer than it will be [s].
double likely_step(const physics::SimulateOptions& o, const physics::Cloth& cloth) {
  if (o.dt) return *o.dt;
  if (physics::is_unconditionally_stable(o.integrator)) return physics::default_dt(o.integrator);
  return std::min(physics::stable_step(cloth).dt_limit, o.dt_max);
}

int steps_between_shown(double dt) {
  for (const int steps : steps_between)
    if (steps * dt <= between_shown) return steps;
  return 1;
}

}  // namespace

double cost_of_step(const physics::SimulateOptions& o, const physics::Cloth& cloth, bool has_body) {
  const bool four_times = o.integrator == physics::Integrator::rk4;
  const double forces = four_times ? 4 : 1;
  const double springs = double(cloth.structural.size() + cloth.bending.size() + cloth.tension.size());
  Work work;
  work.vertices = double(cloth.particles.size());
  work.steps = 1;
  work.springs = forces * springs;
  work.triangles = forces * double(cloth.membrane.size());
  work.hinges = forces * double(int(cloth.hinges.size()) + physics::count_coupled(cloth));
  if (has_body) work.queries = forces * work.vertices / 10;
  if (o.integrator == physics::Integrator::xpbd) work.sweeps = o.xpbd.iterations * springs;
  if (physics::solves_contact(o.integrator)) work.iterations = physics::usual_iterations(o.integrator);
  return cost_of(work, four_times ? costs.rk4_vertex_step : costs.vertex_step);
}

Observation observation_of(const physics::SimulateOptions& options, const physics::Cloth& cloth,
                           bool has_body, bool animated) {
  Observation observation;
  if (animated) observation.shown = steps_between_shown(likely_step(options, cloth));
  if (physics::solves_contact(options.integrator)) {
    observation.steps = 1;
    return observation;
  }
  const double most = longest_stretch / cost_of_step(options, cloth, has_body);
  for (const int steps : steps_between) {
    if (animated && observation.shown % steps != 0) continue;
    observation.steps = steps;
    if (steps <= most) break;
  }
  return observation;
}

}  // namespace furrow::jobs
