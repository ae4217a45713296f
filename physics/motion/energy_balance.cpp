// SPDX-License-Identifier: MIT
#include "physics/motion/energy_balance.h"

#include <cmath>

#include "physics/base/vector_sums.h"

namespace furrow::physics {
namespace {

/// What is not there adds nothing.
void add_if_any(std::vector<Vec3>& sum, double factor, std::span<const Vec3> v) {
  if (!v.empty()) add_multiple(sum, factor, v);
}

}  // namespace

EnergyBalance& EnergyBalance::operator+=(const EnergyBalance& more) {
  seconds += more.seconds;
  kinetic += more.kinetic, elastic += more.elastic, weight += more.weight;
  by_air += more.by_air, by_body += more.by_body, by_pins += more.by_pins;
  by_compensation += more.by_compensation;
  to_air += more.to_air, to_contact += more.to_contact;
  return *this;
}

StepImpulse::StepImpulse(const Particles& particles, double air_drag)
    : particles_(particles), air_drag_(air_drag) {
  for (std::vector<Vec3>* all : {&body_, &cloth_, &air_, &given_, &lead_, &surface_, &slip_})
    all->assign(particles.size(), Vec3::Zero());
}

void StepImpulse::add(double seconds, const FoundForces& forces, const StepLoads& loads,
                      std::span<const Vec3> v) {
  add_if_any(body_, seconds, forces.body);
  add_if_any(cloth_, seconds, forces.cloth);
  add_if_any(given_, seconds, loads.force);
  add_if_any(lead_, seconds, forces.elements.pull);
  add_if_any(lead_, seconds, forces.cloth);
  for (std::size_t i = 0; i < v.size(); ++i) {
    const double drag = seconds * air_drag_ * particles_.mass[i];
    air_[i] -= drag * (loads.air.empty() ? v[i] : Vec3(v[i] - loads.air[i]));
  }
}

void StepImpulse::go_along(std::span<const Vec3> surface, std::span<const Vec3> slip) {
  surface_.assign(surface.begin(), surface.end());
  slip_.assign(slip.begin(), slip.end());
}

EnergyBalance balance_of(const Particles& particles, const Vec3& gravity, const StepPlace& start,
                         const StepPlace& end, const StepImpulse& impulse, double seconds) {
  EnergyBalance sum;
  sum.seconds = seconds;
  sum.elastic = end.elastic - start.elastic;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const double m = particles.mass[i];
    const Vec3 v = 0.5 * (start.v[i] + end.v[i]);
    if (!(particles.inv_mass[i] > 0)) {
      sum.by_pins -= impulse.lead_[i].dot(end.v[i]);
      continue;
    }
    sum.kinetic += m * (end.v[i] - start.v[i]).dot(v);
    sum.weight -= m * gravity.dot(end.x[i] - start.x[i]);
    const double drag = impulse.air_[i].dot(v);
    (drag > 0 ? sum.by_air : sum.to_air) += std::abs(drag);
    sum.by_compensation += impulse.given_[i].dot(v);
    sum.by_body += impulse.body_[i].dot(impulse.surface_[i]);
    sum.to_contact -= impulse.body_[i].dot(impulse.slip_[i]) + impulse.cloth_[i].dot(v);
  }
  return sum;
}

}  // namespace furrow::physics
