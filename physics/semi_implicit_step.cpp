// SPDX-License-Identifier: MIT
#include "physics/semi_implicit_step.h"

#include <stdexcept>
#include <string>

namespace furrow::physics {

void semi_implicit_step(Motion& motion, double dt) {
  if (!(dt > 0)) {
    throw std::invalid_argument("semi_implicit_step: dt = " + std::to_string(dt) + " is not > 0");
  }
  motion.kick_and_drag(dt / 2);
  motion.damp_reverse(dt / 2);
  motion.damp_forward(dt / 2);
  motion.drag_and_kick(dt / 2);
  motion.drift(dt);
  motion.update_forces();
  ++motion.work().steps;
}

}  // namespace furrow::physics
