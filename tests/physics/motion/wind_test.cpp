// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/motion/wind.h"

#include <catch2/catch.hpp>
#include <limits>

#include "physics/motion/simulate.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

Cloth loose(int count) {
  Cloth cloth;
  Noise noise(5);
  for (int i = 0; i < count; ++i) add_particle(cloth, noise.vector(), 0.01 * (i + 1), noise.vector());
  return cloth;
}

SimulateOptions airy(double drag, double seconds) {
  SimulateOptions o;
  o.gravity.setZero();
  o.air_drag = drag;
  o.seconds = seconds;
  return o;
}

}  // namespace

TEST_CASE("wind: in steady wind the velocity decays towards the air's, exactly") {
  Cloth cloth = loose(3);
  const Cloth start = cloth;
  World world;
  world.wind.velocity = Vec3(3, 1, -2);
  simulate(cloth, world, airy(2, 0.7));
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 w = world.wind.velocity, exact = w + std::exp(-1.4) * (start.particles.v[i] - w);
    CHECK((cloth.particles.v[i] - exact).norm() < 1e-12);
  }
}

TEST_CASE("wind: still air is no wind, whichever way it is written") {
  Wind wind;
  CHECK(is_still(wind));
  wind.velocity = Vec3(1, 0, 0);
  CHECK_FALSE(is_still(wind));
  wind.gusts = {{0, 0}, {1, 0}};
  CHECK(is_still(wind));
  wind.swirl = Spin{};
  CHECK(is_still(wind));
  wind.swirl->rate = 1;
  CHECK_FALSE(is_still(wind));
}

TEST_CASE("wind: gusts are linear between their times and held outside, the cloth follows with order two") {
  Wind wind;
  wind.velocity = Vec3(2, 0, 0);
  wind.gusts = {{1, 0.5}, {2, 1.5}, {4, 0}};
  CHECK(gust_factor(wind, 0) == 0.5);
  CHECK(gust_factor(wind, 1.5) == 1);
  CHECK(gust_factor(wind, 3) == 0.75);
  CHECK(gust_factor(wind, 9) == 0);
  CHECK(air_velocity(wind, {7, 7, 7}, 1.5) == Vec3(2, 0, 0));
  // w = a t: v = a t - (a/c) (1 - exp(-c t))
  World world;
  world.wind.velocity = Vec3(1, 0, 0);
  world.wind.gusts = {{0, 0}, {1, 3}};
  const double exact = 3 - 1.5 * (1 - std::exp(-2.0));
  const auto error = [&](double dt) {
    Cloth cloth;
    add_particle(cloth, Vec3::Zero(), 1);
    SimulateOptions options = airy(2, 1);
    options.dt = dt;
    simulate(cloth, world, options);
    return std::abs(cloth.particles.v[0].x() - exact);
  };
  CHECK(error(0.01) < 1e-3);
  CHECK(error(0.01) / error(0.005) == Approx(4).epsilon(0.05));
}

TEST_CASE("wind: a swirl takes a ring along as fast as the air turns") {
  Wind wind;
  wind.swirl = Spin{Vec3(1, 0, 0), Vec3(0, 2, 0), 3, 0, 1};
  CHECK((air_velocity(wind, {1, 5, 1}, 5) - Vec3(3, 0, 0)).norm() < 1e-14);
  CHECK((air_velocity(wind, {1, 5, 1}, 0.5) - Vec3(1.5, 0, 0)).norm() < 1e-14);
  World world;
  world.wind.swirl = Spin{Vec3::Zero(), Vec3::UnitY(), 2, 0, 0};
  Cloth ring;
  const double pi = 3.14159265358979323846;
  for (int i = 0; i < 12; ++i) {
    add_particle(ring, Vec3(0.3 * std::sin(pi * i / 6), 0, 0.3 * std::cos(pi * i / 6)), 0.01);
  }
  for (int i = 0; i < 12; ++i) {
    const double l = (ring.particles.x[0] - ring.particles.x[1]).norm();
    ring.structural.push_back({std::min(i, (i + 1) % 12), std::max(i, (i + 1) % 12), l, 200});
  }
  SimulateOptions options = airy(2, 4);
  options.threads = 2;
  simulate(ring, world, options);
  for (std::size_t i = 0; i < 12; ++i) {
    const Vec3 air = air_velocity(world.wind, ring.particles.x[i], 4);
    CHECK((ring.particles.v[i] - air).norm() < 0.05 * air.norm());
  }
}

TEST_CASE("wind: broken wind is refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Cloth cloth = loose(1);
  World world;
  const auto refused = [&](const char* text) {
    CHECK_THROWS_WITH(simulate(cloth, world, SimulateOptions{}), Catch::Contains(text));
    world.wind = {};
  };
  world.wind.velocity.y() = nan;
  refused("velocity is not finite");
  world.wind.gusts = {{0, 1}, {0, 2}};
  refused("gust 1: time");
  world.wind.gusts = {{nan, 1}};
  refused("gust 0 is not finite");
  world.wind.swirl = Spin{};
  world.wind.swirl->axis.setZero();
  refused("axis");
}
