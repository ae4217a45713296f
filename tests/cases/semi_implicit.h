// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "physics/motion/stepper.h"

namespace furrow::cases {

/// Semi-implicit (symplectic) Euler costs what leapfrog costs and is on the front of no chart (decision 14),
/// so the library does not have it. It is a baseline that charts and tests ask for by this value.
inline constexpr auto semi_implicit = physics::Integrator(-1);

/// physics::make_stepper(), with this baseline added.
std::unique_ptr<physics::Stepper> make_stepper(physics::Motion& motion,
                                               const physics::StepperOptions& options);

/// One step of dt seconds: v += dt a(x); x += dt (new v). Order one; without damping the energy stays within
/// a bound of order dt. Contact acts after the move, so that what rests has velocity 0. One force evaluation.
/// Source: Hairer, Lubich, Wanner, Acta Numerica 12 (2003) 399-450.
///
/// \details Drag and the springs' damping, exact over dt, stand in the middle of the kick. So the step is
/// leapfrog's with its phases turned round, and stable for dt < 2 / omega_max with damping, too (damping by a
/// factor d before the kick would leave sqrt(2 + 2 d) / omega_max).
void semi_implicit_step(physics::Motion& motion, double dt);

}  // namespace furrow::cases
