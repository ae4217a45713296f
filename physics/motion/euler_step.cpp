// SPDX-License-Identifier: MIT
#include "physics/motion/euler_step.h"

#include <stdexcept>
#include <string>

namespace furrow::physics {

void euler_step(Motion& motion, double dt) {
  if (!(dt > 0)) throw std::invalid_argument("euler_step: dt = " + std::to_string(dt) + " is not > 0");
  motion.damp_forward(dt);
  motion.drift(dt);
  motion.kick_and_drag(dt);  // with the forces of the old positions
  motion.update_forces();
  ++motion.work().steps;
}

}  // namespace furrow::physics
