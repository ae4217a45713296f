// SPDX-License-Identifier: MIT
#pragma once
#include "physics/motion.h"

namespace furrow::physics {

/// One step of dt seconds by semi-implicit (symplectic) Euler:  v += dt a(x);  x += dt (new v).
/// Drag and the springs' damping, exact over dt, stand in the middle of the kick: so the step is leapfrog's
/// with its phases turned round, and stable for dt < 2 / omega_max with damping, too (damping by a factor d
/// before the kick would leave sqrt(2 + 2 d) / omega_max). Order one; without damping the energy stays within
/// a bound of order dt; keeps momentum if nothing is pinned, touched or dragged. Contact acts after the move,
/// so that what rests has velocity 0. One force evaluation. Throws std::invalid_argument, nothing changed, if
/// dt is not > 0. Source: Hairer, Lubich, Wanner, Acta Numerica 12 (2003) 399-450.
void semi_implicit_step(Motion& motion, double dt);

}  // namespace furrow::physics
