// SPDX-License-Identifier: MIT
#pragma once

namespace furrow::physics {

enum class Integrator {
  leapfrog,        ///< order 2, symplectic, one force a step; the choice for cloth that moves
  explicit_euler,  ///< order 1; gains energy at any step
  rk4,             ///< order 4, four forces a step; loses energy slowly
  backward_euler,  ///< order 1, stable at any step, damps; a sparse Cholesky solve a step
  xpbd             ///< backward Euler by sweeps over the springs: stable at any step, stiffness needs sweeps
};

/// Whether steps of any length are stable, so that no limit is estimated.
constexpr bool is_unconditionally_stable(Integrator i) {
  return i == Integrator::backward_euler || i == Integrator::xpbd;
}

/// Their steps if none is asked for [s]: XPBD gains more from short steps than from many sweeps.
constexpr double default_dt(Integrator i) { return i == Integrator::xpbd ? 1.0 / 1200 : 1.0 / 240; }

struct BackwardEulerOptions {
  int newton_iterations = 1;        ///< at most; 1: linearised once (Baraff & Witkin 1998); >= 1
  double newton_tolerance = 1e-10;  ///< of velocities: sooner when an iteration changes none more [m/s]; >= 0
};

struct XpbdOptions {
  int iterations = 10;   ///< sweeps over all springs a step, at most; >= 1
  double tolerance = 0;  ///< sooner when a sweep changes no spring's length by more [m]; >= 0
};

/// 2 sqrt(2): RK4 is stable on the imaginary axis up to there. The half-disc of radius 2.785 left of it
/// belongs to its region, too.
constexpr double rk4_limit = 2.8284271247461903, rk4_damped_limit = 2.785;

}  // namespace furrow::physics
