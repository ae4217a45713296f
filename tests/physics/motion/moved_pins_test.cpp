// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/motion/moved_pins.h"

#include <catch2/catch.hpp>

#include "physics/cloth/pins.h"
#include "physics/motion/simulate.h"
#include "tests/physics/body/test_bodies.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

TEST_CASE("moved_pins: moved pins are exactly where their motion says, with its velocity") {
  Cloth cloth = sheet(8, 6, 0.05, 0.1, 2);
  pin(cloth.particles, std::vector<int>{0, 7});
  World world;
  RigidMotion left, right;
  left.keyframes = {{0}, {0.2, Vec3(0.05, 0, 0.1), Vec3(0, 0.5, 0)}, {0.4, Vec3(0, 0.1, 0)}};
  right.keyframes = {{0, Vec3(0, 0, 1)}};  // at time 0 not the identity: the particle starts where it is
  right.spin = Spin{Vec3(0.2, 0, 0), Vec3(0.1, 1, 0), 2, 0.1, 0.1};
  world.pins = {{{0}, left}, {{7}, right}};
  const Vec3 a = cloth.particles.x[0], b = pose(right, 0).to_body(cloth.particles.x[7]);
  SimulateOptions options;
  options.seconds = 0.5;
  options.observe_steps = 7;
  options.threads = GENERATE(1, 2);
  int seen = 0;
  simulate(cloth, world, options, nullptr, [&](const SimulateProgress& p) {
    ++seen;
    CHECK(cloth.particles.x[0] == pose(left, p.time).to_world(a));
    CHECK(cloth.particles.x[7] == pose(right, p.time).to_world(b));
    // The difference quotient is that of the middle of the step.
    const double m = p.time - p.dt / 2, h = 1e-5;
    const Vec3 exact = (pose(right, m + h).to_world(b) - pose(right, m - h).to_world(b)) / (2 * h);
    CHECK((cloth.particles.v[7] - exact).norm() < 1e-5);
    return true;
  });
  CHECK(seen > 10);
  CHECK(cloth.particles.inv_mass[0] == 0);
}

TEST_CASE("moved_pins: a mass on a spring whose other end is shaken does what the driven oscillator does") {
  // m z'' = -k (z - y(t)), y = D (3 s^2 - 2 s^3), s = t/T, z(0) = z'(0) = 0. With y'' = 6 D/T^2 (1 - 2 t/T):
  // e = z - y solves e'' + w^2 e = -y'', so e = -(6 D / (T w)^2) (1 - 2 t/T - cos wt + 2/(w T) sin wt).
  const double mass = 0.1, k = 40, w = std::sqrt(k / mass), T = 0.7, D = 0.2, L = 1;
  Cloth cloth = pendulum(mass, k, L, {0, -L, 0});
  World world;
  world.pins = {{{0}, {}}};
  world.pins[0].motion.keyframes = {{0}, {T, Vec3(0, D, 0)}};
  const auto error = [&](double dt) {
    Cloth c = cloth;
    SimulateOptions o;
    o.gravity.setZero();
    o.air_drag = o.spring_damping = 0;
    o.seconds = T;
    o.dt = dt;
    o.observe_steps = 1;
    double worst = 0;
    simulate(c, world, o, nullptr, [&](const SimulateProgress& p) {
      const double t = p.time, s = t / T, y = D * s * s * (3 - 2 * s);
      const double e =
          -6 * D / (T * T * w * w) * (1 - 2 * s - std::cos(w * t) + 2 / (w * T) * std::sin(w * t));
      worst = std::max(worst, std::abs(c.particles.x[1].y() + L - y - e));
      return true;
    });
    return worst;
  };
  const double coarse = error(2e-3), fine = error(1e-3);
  CHECK(coarse < 1e-3 * D);
  CHECK(coarse / fine == Approx(4).epsilon(0.05));
}

TEST_CASE("moved_pins: spring damping sees their velocity and drags the mass after the pin") {
  // A critically damped pair that flies along with its pin is not braked by the damping.
  Cloth cloth = pendulum(0.1, 40, 1, {0, -1, 0}, {0, -2, 0});
  World world;
  world.pins = {{{0}, uniform_motion({0, -2, 0}, 2)}};
  SimulateOptions options;
  options.gravity.setZero();
  options.air_drag = 0;
  options.spring_damping = 1;
  options.seconds = 1;
  simulate(cloth, world, options);
  CHECK(cloth.particles.x[1].y() == Approx(-3).epsilon(1e-12));
  CHECK(cloth.particles.v[1].y() == Approx(-2).epsilon(1e-12));
}

TEST_CASE("moved_pins: moved pins that do not fit the cloth are refused") {
  Cloth cloth = sheet(4, 4, 0.05);
  pin(cloth.particles, std::vector<int>{0, 3});
  World world;
  const auto refused = [&](std::vector<int> particles, const char* text) {
    world.pins = {{std::move(particles), {}}};
    CHECK_THROWS_WITH(simulate(cloth, world, SimulateOptions{}), Catch::Contains(text));
  };
  refused({0, 16}, "particle 16 is not among 16");
  refused({-1}, "particle -1");
  refused({0, 1}, "particle 1 is not pinned");
  refused({3, 0, 3}, "particle 3 is named twice");
  world.pins = {{{0}, {}}};
  world.pins[0].motion.keyframes = {{1}, {0}};
  CHECK_THROWS_AS(simulate(cloth, world, SimulateOptions{}), std::invalid_argument);
}
