// SPDX-License-Identifier: MIT
#pragma once
#include "physics/motion/stepper.h"

namespace furrow::physics {

/// Extended position-based dynamics: each spring is a constraint l = L of compliance 1/k, each sweep solves
/// one after the other for its own impulse, in the fixed order of the cloth's packed springs and in the
/// reverse order every other time. The springs' damping is the method's own, with the dashpots of dashpots.h.
/// With enough sweeps a step is nearly backward Euler's (order one, amplitude 1/sqrt(1 + z^2); not quite, as
/// an impulse keeps the direction of the sweep that gave it); with few, long waves meet a softer cloth:
/// sweeps count as stiffness. Stable for any dt. Keeps momentum after any number of sweeps if nothing is
/// pinned, touched or dragged.
///
/// What the method calls a substep is a step here: contact, pins and wind are those of each. Contact acts
/// after the sweeps. The impulses act on velocities; positions follow them in the one move at the end, so
/// that rounding does not reach momentum through differences of positions.
/// Rather than projective dynamics, whose factor serves only while dt, masses, pins and springs stay: lines
/// add springs, and implicit_step.h solves globally already. Sweeps need no matrix and run on threads. Cost:
/// `iterations` passes over the springs, each with a square root and two divisions a spring. Sources:
/// Macklin, Müller, Chentanez, XPBD, MIG 2016; Macklin et al., Small Steps, SCA 2019.
class Xpbd : public Stepper {
 public:
  /// Throws std::invalid_argument if an option is out of its range, or the cloth has a membrane, tension or
  /// hinges.
  explicit Xpbd(Motion& motion, const XpbdOptions& options = {});
  void step(double dt) override;

 private:
  void sweep(double dt, bool forward);

  Motion& motion_;
  XpbdOptions options_;
  std::vector<double> dashpots_, impulse_;  // of each spring; impulses [N s]
  std::vector<double> inv_mass_;            // of each spring: of its ends together [1/kg]
};

}  // namespace furrow::physics
