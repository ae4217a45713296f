// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "physics/motion/stepper.h"

namespace furrow::cases {

/// Explicit and semi-implicit (symplectic) Euler are on the front of no chart (decision 14), so the library
/// has neither. They are baselines that charts and tests ask for by these values.
inline constexpr auto semi_implicit = physics::Integrator(-1), explicit_euler = physics::Integrator(-2);

/// physics::make_stepper(), with these baselines added.
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

/// One step of dt seconds: x += dt v; v += dt a(old x), drag and damping exact over dt. The baseline that
/// leapfrog beats (method S1.11): on an undamped spring it gains energy by 1 + (omega dt)^2 each step at any
/// dt. Contact acts after the move. One force evaluation. Throws std::invalid_argument if dt is not > 0.
void euler_step(physics::Motion& motion, double dt);

}  // namespace furrow::cases
