// SPDX-License-Identifier: MIT
#include "physics/motion/simulate_report.h"

#include <optional>

#include "physics/body/moving_body.h"
#include "physics/body/posed_collider.h"
#include "physics/contact/residual_force.h"
#include "physics/motion/compensation.h"

namespace furrow::physics {
namespace {

void take_counts(const SimulateState& state, SimulateReport& report) {
  const SimulateTotals& totals = state.totals;
  report.steps = state.step;
  report.time = state.time;
  report.dt_smallest = state.step > 0 ? totals.dt_smallest : report.dt;
  report.limit_estimates = int(totals.limit_estimates);
  report.force_evaluations = totals.force_evaluations;
  report.linear_solves = totals.linear_solves;
  report.factorisations = totals.factorisations;
  report.iterations = totals.iterations;
  report.open_steps = totals.open_steps;
  report.energy = totals.energy;
  report.longest_edge = totals.longest_edge;
  report.spring_evaluations = totals.spring_evaluations;
  report.triangle_evaluations = totals.triangle_evaluations;
  report.hinge_evaluations = totals.hinge_evaluations;
  report.collider_queries = totals.collider_queries;
  report.truncated_moves = totals.truncated_moves;
  report.cut_moves = totals.cut_moves;
  report.frames_built = totals.frames_built;
  report.frame_seconds = totals.frame_seconds;
  report.seconds = totals.seconds;
  report.cpu_seconds = totals.cpu_seconds;
  report.times = totals.times;
  report.compensation_left = share_left(state.compensation, state.time);
  report.compensation_force = net_force(state.compensation, state.time);
}

}  // namespace

void measure(const Cloth& cloth, const World& world, const SimulateState& state, const Vec3& gravity,
             const ContactOptions& contact, SimulateReport& report) {
  take_counts(state, report);
  report.strain = strain_statistics(cloth);
  report.kinetic_energy = kinetic_energy(cloth.particles);
  const Collider* body = world.collider;
  std::optional<PosedCollider> posed;
  if (world.animated) {
    body = world.animated;
  } else if (body && !is_identity(world.body_motion)) {
    body = &posed.emplace(*body, pose(world.body_motion, state.time));
  }
  report.residual_force = residual_force(cloth, gravity, body, contact.friction, contact.gap);
  if (body) report.contacts = count_contacts(cloth.particles.x, *body, contact.gap);
}

}  // namespace furrow::physics
