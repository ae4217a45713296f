// SPDX-License-Identifier: MIT
#pragma once
#include "physics/motion/motion.h"

namespace furrow::physics {

/// One step of dt seconds by explicit Euler:  x += dt v;  v += dt a(old x), drag and damping exact over dt.
/// The baseline that fails: on an undamped spring it gains energy by 1 + (omega dt)^2 each step at any dt.
/// Contact acts after the move. One force evaluation. Throws std::invalid_argument if dt is not > 0.
void euler_step(Motion& motion, double dt);

}  // namespace furrow::physics
