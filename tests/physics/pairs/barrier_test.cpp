// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/pairs/barrier.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using furrow::tests::Noise;

TEST_CASE("barrier: a force presses a pair to where (1 - u)^2 / u = 2 F / (k range)") {
  const double k = 700, range = 8e-4;
  const double known[][2] = {{0.01, 0.868226}, {0.25, 0.5}, {1, 0.267949}};
  for (const auto& [load, answer] : known) {
    double low = 0, high = 1;
    for (int i = 0; i < 60; ++i) {
      const double u = 0.5 * (low + high);
      (barrier(u * range, range, k).force > load * k * range ? low : high) = u;
    }
    CHECK(low == Approx(answer).epsilon(2e-6));
    const double exact = 1 + load - std::sqrt(load * (2 + load));
    CHECK(low == Approx(exact).epsilon(1e-9));
  }
}

TEST_CASE("barrier: force and stiffness are derivatives of the energy, which begins with its third") {
  const double k = 500, range = 1e-3;
  for (const double u : {0.01, 0.1, 0.5, 0.9, 0.97, 0.9799, 0.9801, 0.99, 0.999}) {
    const double d = u * range, step = 1e-4 * std::min(d, range - d);
    const Barrier up = barrier(d + step, range, k), down = barrier(d - step, range, k),
                  at = barrier(d, range, k);
    CHECK(at.force == Approx((down.energy - up.energy) / (2 * step)).epsilon(1e-6));
    CHECK(at.stiffness == Approx((down.force - up.force) / (2 * step)).epsilon(1e-6));
    CHECK(at.stiffness > 0);
  }
  for (const double u : {1.0, 1.5}) {
    const Barrier none = barrier(u * range, range, k);
    CHECK(none.energy == 0);
    CHECK(none.force == 0);
    CHECK(none.stiffness == 0);
  }
  const double r = 1e-6;
  CHECK(barrier((1 - r) * range, range, k).energy ==
        Approx(0.5 * k * range * range * r * r * r / 3).epsilon(1e-5));
  CHECK(std::isinf(barrier(0, range, k).energy));
}

TEST_CASE("barrier: nearly parallel edges lose it without a jump, with the derivative of differences") {
  const Vec3 e1(0.01, 0, 0);
  const double lengths = 1e-4;
  CHECK(parallel_share(e1, Vec3(0.02, 0, 0), lengths).factor == 0);
  CHECK(parallel_share(e1, Vec3(0, 0.01, 0), lengths).factor == 1);
  Noise noise(5);
  for (int i = 0; i < 200; ++i) {
    const Vec3 a = e1 + 2e-4 * noise.vector(), b = Vec3(0.011, 0, 0) + 2e-4 * noise.vector();
    const ParallelShare at = parallel_share(a, b, lengths);
    CHECK(at.factor >= 0);
    CHECK(at.factor <= 1);
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 step = 1e-9 * Vec3::Unit(axis);
      const auto slope = [&](const Vec3& s, const Vec3& t) {
        return (parallel_share(a + s, b + t, lengths).factor - parallel_share(a - s, b - t, lengths).factor) /
               2e-9;
      };
      CHECK(at.first[axis] == Approx(slope(step, Vec3::Zero())).epsilon(1e-4).margin(1e-2));
      CHECK(at.second[axis] == Approx(slope(Vec3::Zero(), step)).epsilon(1e-4).margin(1e-2));
    }
  }
}
