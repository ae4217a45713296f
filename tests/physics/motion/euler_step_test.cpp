// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "physics/cloth/cloth.h"
#include "physics/linear/stable_step.h"
#include "physics/motion/leapfrog_step.h"
#include "tests/cases/baselines.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using furrow::cases::euler_step;
using namespace furrow::tests;

TEST_CASE("euler_step: it gains amplitude by sqrt(1 + z^2) each step") {
  const double z = GENERATE(0.01, 0.1, 1.0);
  ThreadPool pool(1);
  Motion motion(pendulum(1, 1, 4, {5, 0, 0}), {.gravity = Vec3::Zero()}, pool);
  const int steps = 20;
  for (int i = 0; i < steps; ++i) euler_step(motion, z);
  const auto& moving = motion.cloth().particle[0] == 1 ? 0 : 1;
  const double q = motion.cloth().x[moving].x - 4, v = motion.cloth().v[moving].x;
  // At z = 1 the mass may pass the pin, where the spring's axis turns; amplitudes stay below L for these z.
  if (z < 1) CHECK(q * q + v * v == Approx(std::pow(1 + z * z, steps)).epsilon(1e-12));
  if (z == 1) CHECK(q * q + v * v > 10);
}

TEST_CASE("euler_step: it has order one on the elastic pendulum") {
  const Vec3 exact(0.389103045248, -0.920914325687, 0);
  std::vector<double> errors;
  for (const int steps : {40000, 80000, 160000}) {
    ThreadPool pool(1);
    const Cloth cloth = pendulum(0.1, 50, 1, {1.1, 0.2, 0});
    Motion motion(cloth, {}, pool);
    for (int i = 0; i < steps; ++i) euler_step(motion, 2.0 / steps);
    Particles end = cloth.particles;
    unpack(motion.cloth(), end);
    errors.push_back((end.x[1] - exact).norm());
  }
  CHECK(std::log2(errors[0] / errors[1]) == Approx(1).margin(0.15));
  CHECK(std::log2(errors[1] / errors[2]) == Approx(1).margin(0.1));
}

TEST_CASE("euler_step: it diverges on a cloth at a fifth of leapfrog's limit, where leapfrog holds") {
  Cloth cloth = sheet(8, 8, 0.1, 0.2);
  Noise noise(3);
  for (Vec3& x : cloth.particles.x) x += 1e-6 * noise.vector();
  const double dt = 0.2 * stable_step(cloth).dt_limit;
  ThreadPool pool(1);
  Motion euler(cloth, {.gravity = Vec3::Zero()}, pool), leapfrog(cloth, {.gravity = Vec3::Zero()}, pool);
  for (int i = 0; i < 400; ++i) euler_step(euler, dt), leapfrog_step(leapfrog, dt);
  Cloth end = cloth;
  unpack(leapfrog.cloth(), end.particles);
  CHECK(strain_statistics(end.particles.x, end.structural).max < 1e-3);
  unpack(euler.cloth(), end.particles);
  CHECK(!(strain_statistics(end.particles.x, end.structural).max < 1));
}
