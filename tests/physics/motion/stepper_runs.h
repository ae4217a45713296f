// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "physics/cloth/pins.h"
#include "physics/motion/leapfrog_step.h"
#include "tests/cases/baselines.h"
#include "tests/physics/cloth/test_cloths.h"

namespace furrow::tests {

using physics::Integrator;
using physics::Particles;

/// With all that is solved by iteration solved to rounding.
inline physics::StepperOptions solved(Integrator integrator) {
  return {integrator, {.iterations = 400}, {.tolerance = 1e-9, .few = 60}};
}

/// But for implicit steps, which have tests of their own (implicit_step_test.cpp).
inline const std::vector<Integrator> all_integrators{Integrator::leapfrog, cases::explicit_euler,
                                                     cases::semi_implicit, Integrator::rk4, Integrator::xpbd};

/// After steps of dt from time 0.
inline Particles after(const Cloth& cloth, const physics::Loads& loads,
                       const physics::StepperOptions& options, double dt, int steps, int threads = 1,
                       const physics::Surroundings& around = {}) {
  physics::ThreadPool pool(threads);
  physics::Motion motion(cloth, loads, pool, around);
  const auto stepper = cases::make_stepper(motion, options);
  for (int i = 0; i < steps; ++i) {
    motion.begin_step(i * dt, (i + 1) * dt);
    stepper->step(dt);
  }
  Particles result = cloth.particles;
  motion.unpack(result);
  return result;
}

/// By leapfrog_step() alone.
inline Particles after(const Cloth& cloth, const physics::Loads& loads, double dt, int steps) {
  physics::ThreadPool pool(1);
  physics::Motion motion(cloth, loads, pool);
  for (int i = 0; i < steps; ++i) leapfrog_step(motion, dt);
  Particles result = cloth.particles;
  unpack(motion.cloth(), result);
  return result;
}

/// Of all positions [m].
inline double distance(const Particles& p, const Particles& q) {
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) sum += (p.x[i] - q.x[i]).squaredNorm();
  return std::sqrt(sum);
}

/// A small sheet with two pins, far from rest.
inline Cloth swinging_sheet() {
  Cloth cloth = sheet(5, 4, 0.1, 0.2, 3, 20, 2);
  Noise noise(8);
  for (Vec3& x : cloth.particles.x) x += 0.01 * noise.vector();
  for (Vec3& v : cloth.particles.v) v = 0.5 * noise.vector();
  pin(cloth.particles, std::vector<int>{0, 4});
  return cloth;
}

}  // namespace furrow::tests
