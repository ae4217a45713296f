// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/rest/hinge_friction.h"

#include <catch2/catch.hpp>
#include <limits>
#include <numbers>

#include "physics/cloth/dihedral.h"
#include "physics/cloth/elements.h"
#include "physics/cloth/hinge_forces.h"
#include "tests/physics/cloth/shell_cloths.h"
#include "tests/physics/cloth/strips.h"
#include "tests/physics/rest/settled.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

constexpr double k = 2e-5, edge = 0.02, height = 0.03;

/// Two flaps over an edge along x; the second one's tip is free.
Cloth flaps(double theta = 0) {
  Cloth cloth;
  add_particle(cloth, {0, 0, 0}, 0);
  add_particle(cloth, {edge, 0, 0}, 0);
  add_particle(cloth, {edge / 2, height, 0}, 0);
  add_particle(cloth, {edge / 2, -height * std::cos(theta), -height * std::sin(theta)}, 1e-6);
  cloth.hinges.push_back({{0, 1, 2, 3}, 0, k});
  return cloth;
}

double angle(const Cloth& cloth) {
  const auto& x = cloth.particles.x;
  return dihedral_angle(x[0], x[1], x[2], x[3]);
}

void bend_to(Cloth& cloth, double theta) { cloth.particles.x[3] = flaps(theta).particles.x[3]; }

/// dE/dtheta of all hinges.
double moment(const Cloth& cloth) {
  double sum = 0;
  for (const Hinge& h : cloth.hinges)
    sum += hinge_moment(cloth.hinge_law, h.stiffness, bend(angle(cloth), h.rest_angle)).moment;
  return sum;
}

/// Rest, once more while hinges give way by more than `slip` [rad].
bool settles(Cloth& cloth, const HingeFriction& friction, const SettleOptions& options, double slip) {
  for (int round = 0; round < 200; ++round) {
    const bool converged = settle(cloth, nullptr, options).converged;
    if (update_friction(cloth, friction) <= slip && converged) return true;
  }
  return false;
}

}  // namespace

TEST_CASE(
    "hinge_friction: the loop of moment and angle has the width 2 limit and the area 4 limit (theta_m - "
    "theta_y)") {
  Cloth cloth = flaps();
  const HingeFriction friction = add_hinge_friction(cloth, {.stiffness = 3, .moment = 1e-3});
  REQUIRE(friction.limit.size() == 1);
  const double limit = friction.limit[0], yield = limit / (3 * k), most = 0.9;
  CHECK(limit == Approx(1e-3 * edge));
  REQUIRE(yield < most);
  const int steps = 4000;
  double area = 0, up = 0, down = 0;
  for (int i = 0; i <= 5 * steps; ++i) {  // a quarter of the first cycle brings it onto the loop
    const double phase = 2 * std::numbers::pi * i / steps, before = angle(cloth), m = moment(cloth);
    bend_to(cloth, most * std::sin(phase));
    update_friction(cloth, friction);
    if (i > 4 * steps) area += (moment(cloth) + m) / 2 * (angle(cloth) - before);
    if (i % steps == 0) up = moment(cloth);
    if (i % steps == steps / 2) down = moment(cloth);
  }
  CHECK(area == Approx(4 * limit * (most - yield)).epsilon(1e-3));
  CHECK(up == Approx(limit).epsilon(1e-6));
  CHECK(down == Approx(-limit).epsilon(1e-6));
}

TEST_CASE(
    "hinge_friction: a flap that is let go keeps the angle k_f / (k + k_f) (theta_m - theta_y), or limit / "
    "k") {
  const SettleOptions weightless = down_to(1e-7, Vec3::Zero());
  for (const double moment_limit : {2e-4, 6e-4}) {
    for (const double most : {0.2, 0.6, 1.1}) {
      Cloth cloth = flaps();
      const double ratio = 2;
      const HingeFriction friction = add_hinge_friction(cloth, {.stiffness = ratio, .moment = moment_limit});
      const double limit = friction.limit[0], yield = limit / (ratio * k);
      for (int i = 1; i <= 100; ++i) {
        bend_to(cloth, most * i / 100);
        update_friction(cloth, friction);
      }
      CHECK(settles(cloth, friction, weightless, 1e-8));
      const double kept = std::max(0.0, ratio / (1 + ratio) * (most - yield));
      CAPTURE(moment_limit, most);
      CHECK(angle(cloth) == Approx(std::min(kept, limit / k)).margin(1e-4));
    }
  }
}

TEST_CASE("hinge_friction: a strip that hung from a clamp keeps a curve with friction and none without",
          "[long]") {
  StripOptions small;
  small.rows = 8;
  small.columns = 2;
  const Strip strip = equilateral_strip(small);
  const Vec3 gravity(0, 0, -gravity_for(5, small.density, small.length, small.rigidity));
  const auto lowest = [](const Cloth& c) {
    double z = 0;
    for (const Vec3& x : c.particles.x) z = std::min(z, x.z());
    return -z / StripOptions{}.length;
  };
  const auto run = [&](double moment_limit) {
    Cloth cloth = strip.cloth;
    const HingeFriction friction = add_hinge_friction(cloth, {.stiffness = 1, .moment = moment_limit});
    for (int i = 1; i <= 4; ++i) {
      CHECK(settles(cloth, friction, down_to(1e-6, i / 4.0 * gravity), 1e-6));
    }
    const double hung = lowest(cloth);
    CHECK(settles(cloth, friction, down_to(1e-5, Vec3::Zero()), 1e-6));
    for (std::size_t i = 0; i < friction.limit.size(); ++i) {
      const Hinge& h = cloth.hinges[friction.first + i];
      const auto& x = cloth.particles.x;
      const auto& v = h.vertices;
      const double phi = bend(dihedral_angle(x[v[0]], x[v[1]], x[v[2]], x[v[3]]), h.rest_angle);
      CHECK(std::abs(h.stiffness * phi) <= friction.limit[i] * (1 + 1e-6) + 1e-12);
    }
    return std::pair(hung, lowest(cloth));
  };
  // Without friction the second hinges slide freely: the strip hangs as without them, and comes back flat.
  const auto [loose_hung, loose] = run(0);
  Cloth plain = strip.cloth;
  CHECK(find_rest(plain, down_to(1e-6, gravity)).converged);
  CHECK(loose_hung == Approx(lowest(plain)).margin(1e-3));
  CHECK(loose < 1e-3);
  const double weight_moment = small.density * gravity.norm() * small.length * small.length / 2;
  const auto [hung, kept] = run(0.1 * weight_moment);
  CAPTURE(loose_hung, hung, kept);
  CHECK(hung < loose_hung);
  CHECK(kept > 0.01);
  CHECK(kept < hung);
}

TEST_CASE("hinge_friction: friction is refused where it cannot be, and a cloth without it is what it was") {
  const Cloth good = flaps();
  const auto refused = [&](const HingeFrictionOptions& o, HingeLaw law) {
    Cloth cloth = good;
    cloth.hinge_law = law;
    CHECK_THROWS_AS(add_hinge_friction(cloth, o), std::invalid_argument);
    CHECK(cloth.hinges.size() == 1);
  };
  refused({.stiffness = 0}, HingeLaw::linear);
  refused({.stiffness = std::numeric_limits<double>::infinity()}, HingeLaw::linear);
  refused({.moment = -1}, HingeLaw::linear);
  refused({}, HingeLaw::cosine);
  Cloth cloth = good;
  const HingeFriction none{1, {}};
  CHECK(update_friction(cloth, none) == 0);
  CHECK(cloth.hinges.size() == 1);
  CHECK(cloth.hinges[0].rest_angle == good.hinges[0].rest_angle);
  CHECK_THROWS_AS(update_friction(cloth, HingeFriction{1, {1.0}}), std::invalid_argument);
}
