// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/cases/baselines.h"

#include <stdexcept>
#include <string>

namespace furrow::cases {
namespace {

struct Baseline : physics::Stepper {
  using Step = void (*)(physics::Motion&, double);
  physics::Motion& motion;
  Step one_step;
  Baseline(physics::Motion& m, Step s) : motion(m), one_step(s) {}
  void step(double dt) override { one_step(motion, dt); }
};

}  // namespace

std::unique_ptr<physics::Stepper> make_stepper(physics::Motion& motion,
                                               const physics::StepperOptions& options) {
  if (options.integrator == semi_implicit) return std::make_unique<Baseline>(motion, semi_implicit_step);
  if (options.integrator == explicit_euler) return std::make_unique<Baseline>(motion, euler_step);
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

void euler_step(physics::Motion& motion, double dt) {
  if (!(dt > 0)) throw std::invalid_argument("euler_step: dt = " + std::to_string(dt) + " is not > 0");
  motion.damp_forward(dt);
  motion.drift(dt);
  motion.kick_and_drag(dt);  // with the forces of the old positions
  motion.update_forces();
  ++motion.work().steps;
}

}  // namespace furrow::cases
