// SPDX-License-Identifier: MIT
#pragma once
#include "physics/motion/motion.h"

namespace furrow::physics {

/// One step of dt seconds by leapfrog (velocity Verlet), method S1.11:
///   v += dt/2 a(x);  x += dt v;  v += dt/2 a(x).
/// Damping stands around it, exact and symmetric: springs forward and drag first, drag and springs reversed
/// last, each over dt/2; so the step keeps order two with damping, too. Contact acts between drift and the
/// second half- kick. Stable without damping for dt < 2 / omega_max; keeps momentum if nothing is pinned,
/// touched or dragged. One force evaluation. Throws std::invalid_argument, nothing changed, if dt is not > 0.
/// Source: Hairer, Lubich, Wanner, Acta Numerica 12 (2003) 399-450.
void leapfrog_step(Motion& motion, double dt);

}  // namespace furrow::physics
