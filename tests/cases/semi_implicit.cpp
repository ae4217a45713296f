// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/cases/semi_implicit.h"

#include <stdexcept>
#include <string>

namespace furrow::cases {
namespace {

struct SemiImplicit : physics::Stepper {
  physics::Motion& motion;
  explicit SemiImplicit(physics::Motion& m) : motion(m) {}
  void step(double dt) override { semi_implicit_step(motion, dt); }
};

}  // namespace

std::unique_ptr<physics::Stepper> make_stepper(physics::Motion& motion,
                                               const physics::StepperOptions& options) {
  if (options.integrator == semi_implicit) return std::make_unique<SemiImplicit>(motion);
  return physics::make_stepper(motion, options);
}

void semi_implicit_step(physics::Motion& motion, double dt) {
  if (!(dt > 0))
    throw std::invalid_argument("semi_implicit_step: dt = " + std::to_string(dt) + " is not > 0");
  motion.kick_and_drag(dt / 2);
  motion.damp_reverse(dt / 2);
  motion.damp_forward(dt / 2);
  motion.drag_and_kick(dt / 2);
  motion.drift(dt);
  motion.update_forces();
  ++motion.work().steps;
}

}  // namespace furrow::cases
