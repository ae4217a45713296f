// SPDX-License-Identifier: GPL-3.0-or-later
// What must not move an equilibrium does not: chains and strips.
#include "tests/cases/metamorphic.h"

#include <catch2/catch.hpp>

#include "tests/physics/cloth/strips.h"
#include "tests/physics/rest/hanging_chains.h"
#include "tests/physics/rest/settled.h"

using namespace furrow;
using namespace furrow::cases;
using physics::Integrator;
using physics::Vec3;

namespace {

/// In shares of the size [-].
constexpr double target = 1e-3;

RestCase chain(Integrator integrator) {
  RestCase c;
  c.cloth = tests::hanging_chain();
  c.size = tests::chain_span;
  c.still = 1e-5;
  c.options.seconds = 60;
  c.options.integrator = integrator;
  if (is_unconditionally_stable(integrator)) c.options.dt = default_dt(integrator);
  return c;
}

RestCase strip(Integrator integrator) {
  tests::StripOptions o;
  o.rows = 3, o.columns = 1, o.rigidity = 1e-4, o.young = 200;
  RestCase c;
  c.cloth = tests::equilateral_strip(o).cloth;
  c.size = o.length;
  c.still = 1e-5;
  c.options.seconds = 60;
  c.options.integrator = integrator;
  c.options.gravity = {0, 0, -tests::gravity_for(10, o.density, o.length, o.rigidity)};
  c.options.air_drag = 6;
  if (is_unconditionally_stable(integrator)) c.options.dt = default_dt(integrator);
  return c;
}

double moved(const RestCase& c, const Rest& from) {
  const Rest rest = come_to_rest(c);
  CHECK(rest.at_rest);
  return farthest(rest.x, from.x) / c.size;
}

std::vector<Vec3> rest_by_newton(const RestCase& c) {
  physics::Cloth cloth = c.cloth;
  REQUIRE(tests::find_rest(cloth, tests::down_to(1e-6, c.options.gravity)).stable);
  return cloth.particles.x;
}

void check_changes(const RestCase& c) {
  CAPTURE(int(c.options.integrator));
  const Rest rest = come_to_rest(c);
  REQUIRE(rest.at_rest);
  CHECK(moved(rotated(c), rest) < target);
  CHECK(moved(permuted(c), rest) < target);
  CHECK(moved(in_small_units(c), rest) < target);
  CHECK(moved(in_small_units(permuted(rotated(permuted(c, 2)))), rest) < target);
  CHECK(moved(with_half_step(c), rest) < target);
  CHECK(moved(with_tenfold_damping(c), rest) < target);
  CHECK(farthest(rest.x, rest_by_newton(c)) < target * c.size);
  CHECK(farthest(rest.x, c.cloth.particles.x) > 0.1 * c.size);
}

}  // namespace

TEST_CASE("metamorphic: a chain hangs where it hangs, whatever the frame, order, unit, step and damping",
          "[release]") {
  for (const Integrator i : {Integrator::leapfrog, Integrator::rk4, Integrator::implicit, Integrator::xpbd}) {
    check_changes(chain(i));
  }
}

TEST_CASE("metamorphic: a cantilever bends as it bends, whatever the frame, order, unit, step and damping",
          "[release]") {
  for (const Integrator i : {Integrator::leapfrog, Integrator::rk4, Integrator::implicit}) {
    check_changes(strip(i));
  }
}

TEST_CASE("metamorphic: with one sweep XPBD's chain hangs lower, and the step decides where", "[release]") {
  RestCase c = chain(Integrator::xpbd);
  c.options.xpbd.iterations = 1;
  const Rest rest = come_to_rest(c), half = come_to_rest(with_half_step(c));
  const std::vector<Vec3> exact = rest_by_newton(c);
  CHECK(farthest(rest.x, exact) > target * c.size);
  CHECK(farthest(half.x, exact) < farthest(rest.x, exact) / 2);
  CHECK(moved(rotated(c), rest) < 1e-9);
}

TEST_CASE("metamorphic: cases with a body are refused, for only their caller can change it", "[release]") {
  struct Nothing : physics::Collider {
    physics::SignedDistance at(const Vec3&) const override { return {1, {0, 1, 0}}; }
  } body;
  RestCase c = chain(Integrator::leapfrog);
  c.body = &body;
  CHECK_THROWS_AS(rotated(c), std::invalid_argument);
  CHECK_THROWS_AS(permuted(c), std::invalid_argument);
  CHECK_THROWS_AS(in_small_units(c), std::invalid_argument);
}
