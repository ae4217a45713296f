// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/contact/residual_force.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "tests/physics/body/test_bodies.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

TEST_CASE("residual_force: free fall is 1, a loaded spring in balance is 0") {
  const Vec3 g(0, -9.81, 0);
  Cloth cloth = pendulum(0.2, 40, 1, {0, -1, 0});
  CHECK(residual_force(cloth, g, nullptr, 0.3, 0.003) == Approx(1));
  cloth.particles.x[1].y() = -1 - 0.2 * 9.81 / 40;
  CHECK(residual_force(cloth, g, nullptr, 0.3, 0.003) < 1e-12);
}

TEST_CASE("residual_force: it is not a number where a position is none") {
  Cloth cloth = pendulum(0.2, 40, 1, {0, -1, 0});
  cloth.tension.push_back({0, 1, 1, 40, 4});
  cloth.particles.x[1].x() = std::numeric_limits<double>::quiet_NaN();
  for (const Vec3& g : {Vec3(0, -9.81, 0), Vec3(0, 0, 0)}) {
    CHECK(std::isnan(residual_force(cloth, g, nullptr, 0.3, 0.003)));
    Cloth tied = cloth;
    tied.structural.clear();
    CHECK(std::isnan(residual_force(tied, g, nullptr, 0.3, 0.003)));
  }
}

TEST_CASE("residual_force: residual force takes the best contact force in the friction cone") {
  // A mass on the floor, pulled by a spring whose other end is pinned; the spring's force is f.
  const double mu = 0.5, m = 0.1, g = 10, k = 100;
  const Floor floor;
  const auto residual = [&](const Vec3& f, double height) {
    Cloth cloth;
    add_particle(cloth, Vec3(0, height, 0), m);
    const Vec3 far = Vec3(0, height, 0) + f.normalized() * (1 + f.norm() / k);
    add_particle(cloth, far, 1);
    cloth.particles.inv_mass[1] = 0;
    cloth.structural.push_back({0, 1, 1, k});
    return residual_force(cloth, Vec3(0, -g, 0), &floor, mu, 0.003) * m * g;
  };
  CHECK(residual({0.49, 0, 0}, 0.003) < 1e-9);                                   // inside the cone: sticks
  CHECK(residual({0.7, 0, 0}, 0.003) == Approx((0.7 - 0.5) / std::sqrt(1.25)));  // slides
  CHECK(residual({0, 1.5, 0}, 0.003) == Approx(0.5));                            // lifts off
  CHECK(residual({0.4, 1.1, 0}, 0.003) == Approx((0.4 + 0.5 * 0.1) / std::sqrt(1.25)));  // between
  CHECK(residual({0.1, 2, 0}, 0.003) == Approx(std::hypot(0.1, 1)));                     // polar cone
  CHECK(residual({0.49, 0, 0}, 0.0031) == Approx(std::hypot(0.49, 1)));                  // no contact
}

TEST_CASE("residual_force: loads count with the weight, one a particle") {
  Cloth cloth = pendulum(0.2, 40, 1, {0, -1, 0});
  const Vec3 g(0, -9.81, 0);
  std::vector<Vec3> loads{Vec3(5, 5, 5), -0.2 * g};  // that on a pin does not count
  CHECK(residual_force(cloth, g, nullptr, 0, 0.003, loads) < 1e-12);
  loads[1].x() = 0.2 * 9.81;
  CHECK(residual_force(cloth, g, nullptr, 0, 0.003, loads) == Approx(1));
  loads.pop_back();
  CHECK_THROWS_WITH(residual_force(cloth, g, nullptr, 0, 0.003, loads), Catch::Contains("1 loads"));
}
