// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/motion/state_memory.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "physics/cloth/pins.h"
#include "tests/cases/friction.h"
#include "tests/physics/motion/stacked_sheets.h"

using namespace furrow::physics;
using namespace furrow::tests;
using furrow::cases::Plane;

namespace {

double farthest_apart(const Cloth& a, const Cloth& b) {
  double most = 0;
  for (std::size_t i = 0; i < std::min(a.particles.size(), b.particles.size()); ++i)
    most = std::max(most, (a.particles.x[i] - b.particles.x[i]).norm());
  return most;
}

/// On a slope of 15 degrees that friction holds it on, across z.
Cloth sheet_on_slope(const Plane& slope) {
  Cloth cloth = level_sheet(0.2, 5, 0, 0, 3);
  const Mat3 turn = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), slope.n).toRotationMatrix();
  for (Vec3& x : cloth.particles.x) x = turn * x + 0.003 * slope.n;
  return cloth;
}

SimulateOptions by(Integrator integrator, double seconds) {
  SimulateOptions o;
  o.integrator = integrator;
  o.seconds = seconds;
  o.friction = 0.4;
  return o;
}

}  // namespace

TEST_CASE(
    "carry_memory: cloth that was not changed stays where friction holds it, forgotten friction creeps") {
  const Plane slope({std::sin(0.26), std::cos(0.26), 0});
  const Integrator integrator = GENERATE(Integrator::implicit, Integrator::tr_bdf2);
  Cloth whole = sheet_on_slope(slope);
  World world;
  world.collider = &slope;
  SimulateState state;
  simulate(whole, world, by(integrator, 0.5), &state);
  REQUIRE(state.steps.anchors.size() == whole.particles.size());
  Cloth carried = whole, forgotten = whole;
  SimulateState with = state, without = state;
  carry_memory(whole, whole, with);
  CHECK(with.steps.anchors == state.steps.anchors);
  CHECK(with.steps.fresh.empty());
  with.planned = without.planned = false;
  without.steps = {};
  simulate(whole, world, by(integrator, 0.7), &state);
  simulate(carried, world, by(integrator, 0.7), &with);
  simulate(forgotten, world, by(integrator, 0.7), &without);
  CHECK(farthest_apart(whole, carried) < 1e-6);
  CHECK(farthest_apart(whole, forgotten) > 1e-5);
}

TEST_CASE("carry_memory: layers that touch go on as they did") {
  const Integrator integrator = GENERATE(Integrator::implicit, Integrator::leapfrog);
  Cloth whole = level_sheet(0.3, 6, 0, 0, 3);
  std::vector<int> held;
  for (std::size_t i = 0; i < whole.particles.size(); ++i) held.push_back(int(i));
  put_over(whole, level_sheet(0.2, 5, 0.0012, 0.05, 4));
  pin(whole.particles, held);
  SimulateOptions o = by(integrator, 0.25);
  o.gravity = {0, 0, -9.81};
  o.self = {true, 1e-3, 0.3};
  SimulateState state;
  simulate(whole, World{}, o, &state);
  REQUIRE(state.steps.self.stiffness > 0);
  if (integrator == Integrator::implicit) REQUIRE(state.steps.self.friction.size() > 10);
  Cloth carried = whole;
  SimulateState with = state;
  carry_memory(whole, whole, with);
  with.planned = false;
  CHECK(with.steps.self.pairs == state.steps.self.pairs);
  CHECK(with.steps.self.friction == state.steps.self.friction);
  o.seconds = 0.3;
  simulate(whole, World{}, o, &state);
  simulate(carried, World{}, o, &with);
  CHECK(farthest_apart(whole, carried) < 1e-6);
}

TEST_CASE("carry_memory: what stays keeps its entries, what is new or was moved has none and is fresh") {
  const Cloth before = level_sheet(0.2, 4, 0, 0, 3);
  const int n = int(before.particles.size());
  Cloth after = before;
  add_particle(after, {0.05, 0.05, 0}, 1e-3);
  after.particles.x[2].z() += 0.01;
  SimulateState state;
  for (int i = 0; i < n; ++i) {
    const Vec3 x(i, 1, 2);
    state.contact.push_back({x, 0.1});
    state.steps.anchors.push_back({x, Vec3::UnitZ(), 0.5, i % 2 == 0, 1e-4});
    state.steps.acceleration.push_back(x);
    state.compensation.force.push_back(x);
  }
  state.steps.self.stiffness = 10;
  state.steps.self.pairs = {{true, {0, 1, 3, 4}, 1e-4, 1e-3}, {false, {5, 2, 3, 4}, 1e-4, 1e-3}};
  state.steps.self.friction = {{true, {0, 1, 3, 4}, Vec3::UnitX(), true}, {false, {2, 3, 4, 5}, {}, false}};
  state.steps.self.loose = {2, 3};
  state.steps.self.coupled = state.steps.self.ordered_for = {{4, 0}};
  const SimulateState was = state;
  carry_memory(before, after, state);
  CHECK(state.steps.fresh == std::vector<int>{2, n});
  for_each_particle_array(state, [&](const char* what, const auto& array, Carried carried) {
    CAPTURE(what);
    CHECK(array.size() == (carried == Carried::never ? 0u : std::size_t(n) + 1));
  });
  CHECK(state.steps.anchors[1] == was.steps.anchors[1]);
  for (const int i : {2, n}) {
    CHECK(state.steps.anchors[std::size_t(i)] == ContactAnchor{});
    CHECK(std::isnan(state.contact[std::size_t(i)].level));
  }
  CHECK(state.compensation.force[2] == was.compensation.force[2]);
  CHECK(state.compensation.force.back() == Vec3::Zero());
  CHECK(state.steps.self.pairs == std::vector{was.steps.self.pairs[0]});
  CHECK(state.steps.self.friction == std::vector{was.steps.self.friction[0]});
  CHECK(state.steps.self.loose == was.steps.self.loose);
  CHECK(state.steps.self.coupled.empty());
  CHECK_NOTHROW(check(state, std::size_t(n) + 1));
  CHECK_THROWS_AS(check(state, std::size_t(n)), std::invalid_argument);  // planned or not
  CHECK_THROWS_AS(carry_memory(after, before, state), std::invalid_argument);
  CHECK(state.steps.fresh.size() == 2);
}

TEST_CASE("carry_memory: a particle that comes to lie deep in the gap is led out, not shot out") {
  const Plane floor({0, 0, 1});
  World world;
  world.collider = &floor;
  SimulateOptions o = by(Integrator::implicit, 0.3);
  o.gravity = {0, 0, -9.81};
  Cloth cloth = level_sheet(0.2, 5, 0.003, 0, 3);
  SimulateState state;
  simulate(cloth, world, o, &state);
  const Cloth before = cloth;
  cloth.particles.x[14].z() = 0.0005;  // as a valley that was drawn
  carry_memory(before, cloth, state);
  state.planned = false;
  o.seconds = 0.35;
  double fastest = 0;
  o.observe_steps = 1;
  simulate(cloth, world, o, &state, [&](const SimulateProgress&) {
    for (const Vec3& v : cloth.particles.v) fastest = std::max(fastest, v.norm());
    return true;
  });
  CHECK(state.steps.fresh.empty());
  CHECK(fastest < 0.2);
  CHECK(cloth.particles.x[14].z() > 0.001);
}
