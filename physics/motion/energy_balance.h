// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

#include "physics/motion/motion.h"
#include "physics/motion/step_search.h"

namespace furrow::physics {

/// Where particles are at one end of a step and how they move, one entry each, and the elements' energy.
struct StepPlace {
  std::span<const Vec3> x, v;  ///< [m], [m/s]
  double elastic;              ///< [J]
};

/// What gave particles their change of velocity in an implicit step, beside elements and weight.
class StepImpulse {
 public:
  StepImpulse(const Particles& particles, double air_drag);
  /// Forces that act for so many seconds, with drag at velocities v [m/s].
  void add(double seconds, const FoundForces& forces, const StepLoads& loads, std::span<const Vec3> v);
  /// Velocities of the body's point next to each particle and of the particle along it [m/s].
  void go_along(std::span<const Vec3> surface, std::span<const Vec3> slip);

 private:
  friend EnergyBalance balance_of(const Particles&, const Vec3&, const StepPlace&, const StepPlace&,
                                  const StepImpulse&, double);
  const Particles& particles_;
  double air_drag_;
  /// One a particle [N s]; `lead`: of elements and of cloth on cloth, for what does not move by itself.
  std::vector<Vec3> body_, cloth_, air_, given_, lead_;
  std::vector<Vec3> surface_, slip_;  ///< [m/s]
};

/// The balance of one step. What a force gives the motion, or takes, is its impulse times the mean velocity.
/// That of the body goes by the velocity of its surface and the slip along it. Of what is led, the velocity
/// at the end counts. What is left is the steps': what they lose between kinetic energy and that of elements
/// and weight, and what the search left. Gravity [m/s^2]. O(particles).
EnergyBalance balance_of(const Particles& particles, const Vec3& gravity, const StepPlace& start,
                         const StepPlace& end, const StepImpulse& impulse, double seconds);

}  // namespace furrow::physics
