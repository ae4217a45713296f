// SPDX-License-Identifier: MIT
#pragma once
#include "physics/motion.h"

namespace furrow::physics {

/// One step of dt seconds by semi-implicit (symplectic) Euler:  v += dt a(x);  x += dt (new v), with springs'
/// damping and drag, each exact over dt, before the kick. Order one; without damping stable for
/// dt < 2 / omega_max, where its energy stays within a bound of order dt; keeps momentum if nothing is
/// pinned, touched or dragged. Contact acts after the move, so that what rests has velocity 0. One force
/// evaluation. Throws std::invalid_argument, nothing changed, if dt is not > 0.
/// Source: Hairer, Lubich, Wanner, Acta Numerica 12 (2003) 399-450.
void semi_implicit_step(Motion& motion, double dt);

}  // namespace furrow::physics
