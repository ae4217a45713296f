// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/motion/leapfrog_step.h"

#include <catch2/catch.hpp>

#include "physics/cloth/pins.h"
#include "physics/cloth/spring_forces.h"
#include "physics/linear/stable_step.h"
#include "tests/physics/motion/stepper_runs.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

/// Orders measured from the differences of runs with dt, dt/2, dt/4, dt/8.
std::vector<double> orders(const Loads& loads) {
  std::vector<Particles> runs;
  for (const int steps : {800, 1600, 3200, 6400})
    runs.push_back(after(swinging_sheet(), loads, 0.2 / steps, steps));
  const double a = distance(runs[0], runs[1]), b = distance(runs[1], runs[2]), c = distance(runs[2], runs[3]);
  return {std::log2(a / b), std::log2(b / c)};
}

Vec3 momentum(const Particles& p) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < p.size(); ++i) sum += p.mass[i] * p.v[i];
  return sum;
}

Vec3 angular_momentum(const Particles& p) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < p.size(); ++i) sum += p.mass[i] * p.x[i].cross(p.v[i]);
  return sum;
}

}  // namespace

TEST_CASE("leapfrog_step: it reaches the elastic pendulum's end point with order two") {
  const Vec3 exact(0.389103045248, -0.920914325687, 0);
  std::vector<double> errors;
  for (const int steps : {4000, 8000, 16000}) {
    const Particles end = after(pendulum(0.1, 50, 1, {1.1, 0.2, 0}), {}, 2.0 / steps, steps);
    errors.push_back((end.x[1] - exact).norm());
  }
  CHECK(errors[0] < 1e-4);
  CHECK(std::log2(errors[0] / errors[1]) == Approx(2).margin(0.03));
  CHECK(std::log2(errors[1] / errors[2]) == Approx(2).margin(0.03));
}

TEST_CASE("leapfrog_step: it has order two on a cloth, with drag and with spring damping, too") {
  const Loads loads =
      GENERATE(Loads{.air_drag = 0, .spring_damping = 0}, Loads{.air_drag = 5, .spring_damping = 0},
               Loads{.air_drag = 0, .spring_damping = 0.3}, Loads{.air_drag = 2, .spring_damping = 0.02});
  CAPTURE(loads.air_drag, loads.spring_damping);
  for (const double order : orders(loads)) CHECK(order == Approx(2).margin(0.03));
}

TEST_CASE("leapfrog_step: a cloth falls as the parabola says") {
  Cloth cloth = sheet(6, 6, 0.1, 0.2);
  const Vec3 v(0.3, 2, -0.1), g(0.5, -9.81, 0.25);
  for (Vec3& u : cloth.particles.v) u = v;
  const Particles end = after(cloth, {.gravity = g}, 2e-4, 5000);
  for (std::size_t i = 0; i < end.size(); ++i) {
    CHECK((end.x[i] - (cloth.particles.x[i] + v + 0.5 * g)).norm() < 1e-12);
    CHECK((end.v[i] - (v + g)).norm() < 1e-10);  // rounding of l - L shakes the springs a little
  }
}

TEST_CASE("leapfrog_step: it keeps momentum and angular momentum, with spring damping, too") {
  Cloth cloth = swinging_sheet();
  for (std::size_t i = 0; i < cloth.particles.size(); ++i)
    cloth.particles.inv_mass[i] = 1 / cloth.particles.mass[i];
  const double damping = GENERATE(0.0, 0.1);
  double p_scale = 0, l_scale = 0;
  for (std::size_t i = 0; i < cloth.particles.size(); ++i) {
    p_scale += cloth.particles.mass[i] * cloth.particles.v[i].norm();
    l_scale += cloth.particles.mass[i] * cloth.particles.v[i].norm() * cloth.particles.x[i].norm();
  }
  const Particles end = after(cloth, {.gravity = Vec3::Zero(), .spring_damping = damping}, 5e-4, 4000);
  CHECK(distance(end, cloth.particles) > 0.01);
  CHECK((momentum(end) - momentum(cloth.particles)).norm() < 1e-12 * p_scale);
  CHECK((angular_momentum(end) - angular_momentum(cloth.particles)).norm() < 1e-12 * l_scale);
}

TEST_CASE("leapfrog_step: it keeps its modified energy over a million steps") {
  // Along its axis a spring is linear: q = x - L obeys q'' = -omega^2 q.
  const double omega = 1, z = 0.5, dt = z / omega;
  ThreadPool pool(1);
  Motion motion(pendulum(1, omega * omega, 4, {5, 0, 0}), {.gravity = Vec3::Zero()}, pool);
  Particles p;
  p.x = p.v = {Vec3::Zero(), Vec3::Zero()};
  const auto energy = [&] {
    unpack(motion.cloth(), p);
    const double q = p.x[1].x() - 4;
    return p.v[1].squaredNorm() + omega * omega * (1 - z * z / 4) * q * q;
  };
  const double start = (unpack(motion.cloth(), p), 1 - z * z / 4);
  double worst = 0;
  for (int i = 1; i <= 1000000; ++i) {
    leapfrog_step(motion, dt);
    if (i % 1000 == 7) worst = std::max(worst, std::abs(energy() - start));
  }
  CHECK(worst < 1e-10);
}

TEST_CASE("leapfrog_step: run backwards it returns to the start") {
  Cloth cloth = swinging_sheet();
  const Particles start = cloth.particles;
  cloth.particles = after(cloth, {}, 1e-3, 300);
  CHECK(distance(cloth.particles, start) > 0.05);
  for (Vec3& v : cloth.particles.v) v = -v;
  cloth.particles = after(cloth, {}, 1e-3, 300);
  CHECK(distance(cloth.particles, start) < 1e-9);
}

TEST_CASE("leapfrog_step: it is stable at 0.98 of 2/omega_max and diverges at 1.03") {
  const double jitter = GENERATE(0.0, 0.3, 0.45);
  Cloth cloth = sheet(8, 8, 0.1, jitter, 4, GENERATE(20, 2000), 5);
  const double limit = stable_step(cloth, {.tolerance = 1e-6}).dt_limit;
  Noise noise(12);
  const Particles rest = cloth.particles;
  for (Vec3& x : cloth.particles.x) x += 1e-10 * noise.vector();
  const double start = distance(cloth.particles, rest);
  const Loads weightless{.gravity = Vec3::Zero()};
  const Particles stable = after(cloth, weightless, 0.98 * limit, 3000);
  CHECK(distance(stable, rest) < 100 * start);
  const Particles diverged = after(cloth, weightless, 1.03 * limit, 60);
  CHECK(!(distance(diverged, rest) < 1e4 * start));
}

TEST_CASE("leapfrog_step: it refuses a step that is not positive") {
  ThreadPool pool(1);
  Motion motion(sheet(3, 3, 0.1), {}, pool);
  CHECK_THROWS_AS(leapfrog_step(motion, 0), std::invalid_argument);
  CHECK_THROWS_AS(Motion(sheet(3, 3, 0.1), {.air_drag = -1}, pool), std::invalid_argument);
  CHECK_THROWS_AS(Motion(sheet(3, 3, 0.1), {.spring_damping = -1}, pool), std::invalid_argument);
}
