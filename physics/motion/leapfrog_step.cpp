// SPDX-License-Identifier: MIT
#include "physics/motion/leapfrog_step.h"

#include <stdexcept>
#include <string>

namespace furrow::physics {

void leapfrog_step(Motion& motion, double dt) {
  if (!(dt > 0)) throw std::invalid_argument("leapfrog_step: dt = " + std::to_string(dt) + " is not > 0");
  motion.damp_forward(dt / 2);
  motion.drag_and_kick(dt / 2);
  motion.drift(dt);
  motion.update_forces();
  motion.kick_and_drag(dt / 2);
  motion.damp_reverse(dt / 2);
  ++motion.work().steps;
}

}  // namespace furrow::physics
