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
  static_cast<SimulateTotals&>(report) = state.totals;
  if (state.step == 0) report.dt_smallest = report.dt;
  report.steps = state.step;
  report.time = state.time;
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
