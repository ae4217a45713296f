// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "physics/base/cancel_scope.h"
#include "physics/cloth/pins.h"
#include "physics/motion/simulate.h"
#include "tests/physics/body/test_bodies.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

struct Scene {
  Cloth cloth;
  World world;
  SimulateOptions options;
  SimulateState state;
};

/// Everything at once: a body that spins and goes along, moved pins, gusts, a swirl, forces to compensate.
Scene busy_scene(const Collider& body) {
  Scene scene;
  scene.cloth = sheet(14, 13, 0.04, 0.1, 7);
  for (Vec3& x : scene.cloth.particles.x) x = Vec3(x.x() - 0.27, 0.215, -x.y() - 0.2);
  pin(scene.cloth.particles, std::vector<int>{0, 13});
  World& world = scene.world;
  world.collider = &body;
  world.body_motion = uniform_motion({0.1, 0.05, 0}, 2);
  world.body_motion.spin = Spin{Vec3::Zero(), Vec3(0.2, 1, 0), 4, 0, 0.1};
  RigidMotion lift;
  lift.keyframes = {{0}, {0.1, Vec3(0.02, 0.03, 0)}, {0.3, Vec3(0, 0.05, 0.02), Vec3(0, 0.1, 0)}};
  world.pins = {{{13}, lift}};
  world.wind.velocity = Vec3(0, 0, 2);
  world.wind.gusts = {{0, 0}, {0.1, 2}, {0.2, 0.5}};
  world.wind.swirl = Spin{Vec3::Zero(), Vec3::UnitY(), 2};
  scene.options.seconds = 0.25;
  scene.options.limit_steps = 150;
  scene.options.friction = 0.5;
  Noise noise(9);
  for (std::size_t i = 0; i < scene.cloth.particles.size(); ++i)
    scene.state.compensation.force.push_back(1e-3 * noise.vector());
  scene.state.compensation.time_constant = 0.05;
  return scene;
}

void check_same(const Scene& a, const SimulateReport& ra, const Scene& b, const SimulateReport& rb) {
  CHECK(a.cloth.particles.x == b.cloth.particles.x);
  CHECK(a.cloth.particles.v == b.cloth.particles.v);
  CHECK(ra.steps == rb.steps);
  CHECK(ra.time == rb.time);
  CHECK(ra.dt == rb.dt);
  CHECK(ra.dt_smallest == rb.dt_smallest);
  CHECK(ra.dt_limit == rb.dt_limit);
  CHECK(ra.dt_limit_smallest == rb.dt_limit_smallest);
  CHECK(ra.limit_estimates == rb.limit_estimates);
  CHECK(ra.force_evaluations == rb.force_evaluations);
  CHECK(ra.linear_solves == rb.linear_solves);
  CHECK(ra.factorisations == rb.factorisations);
  CHECK(ra.iterations == rb.iterations);
  CHECK(ra.collider_queries == rb.collider_queries);
  CHECK(ra.truncated_moves == rb.truncated_moves);
  CHECK(ra.compensation_left == rb.compensation_left);
}

}  // namespace

TEST_CASE("simulate: a run that is stopped twenty times gives the bits of one that is not", "[long]") {
  const Sphere ball(Vec3::Zero(), 0.2);
  const std::uint64_t seed = GENERATE(1, 2, 3);
  Scene whole = busy_scene(ball), parts = whole;
  if (seed == 2) whole.world.body_motion = parts.world.body_motion = {};  // the body at rest
  if (seed == 3) {
    whole.options.integrator = Integrator::rk4;
    whole.options.spring_damping = 0.3;
    whole.options.seconds = 0.15;
    parts.options = whole.options;
  }
  const SimulateReport one = simulate(whole.cloth, whole.world, whole.options, &whole.state);
  REQUIRE(one.outcome == Outcome::finished);
  CHECK(one.contacts > 3);
  CHECK(one.limit_estimates > 3);
  CHECK(one.compensation_left > 0);

  Noise noise(seed);
  std::vector<double> stops;
  for (int i = 0; i < 20; ++i) stops.push_back(parts.options.seconds * (0.5 + 0.5 * noise()));
  std::sort(stops.begin(), stops.end());
  parts.options.observe_steps = 1;
  for (std::size_t i = 0; i < stops.size(); ++i) {
    parts.options.threads = noise() < 0 ? 1 : 2;
    const auto watch = [&](const SimulateProgress& p) { return p.time < stops[i]; };
    if (i % 2) parts.options.stop_at = stops[i];
    const SimulateReport part =
        simulate(parts.cloth, parts.world, parts.options, &parts.state, i % 2 ? Observer{} : watch);
    CHECK(part.outcome == (i % 2 ? Outcome::stopped_at : Outcome::stopped_by_observer));
    CHECK(part.time < stops[i] + 2 * part.dt);
    CHECK(part.steps == parts.state.step);
    parts.options.stop_at.reset();
  }
  const SimulateReport rest = simulate(parts.cloth, parts.world, parts.options, &parts.state);
  CHECK(rest.outcome == Outcome::finished);
  check_same(whole, one, parts, rest);

  const Cloth end = parts.cloth;
  const SimulateReport nothing = simulate(parts.cloth, parts.world, parts.options, &parts.state);
  CHECK(nothing.steps == rest.steps);
  CHECK(parts.cloth.particles.x == end.particles.x);
  CHECK(parts.cloth.particles.v == end.particles.v);
}

TEST_CASE(
    "simulate: a run with any integrator that is stopped in the middle gives the bits of one that is not",
    "[long]") {
  const Sphere ball(Vec3::Zero(), 0.2);
  const Integrator integrator = GENERATE(Integrator::leapfrog, Integrator::rk4, Integrator::xpbd,
                                         Integrator::implicit, Integrator::tr_bdf2);
  Scene whole = busy_scene(ball);
  whole.options.integrator = integrator;
  whole.options.spring_damping = 0.3;
  if (solves_contact(integrator)) whole.options.dt = 1.0 / 240;
  Scene parts = whole;
  const SimulateReport one = simulate(whole.cloth, whole.world, whole.options, &whole.state);
  CAPTURE(int(integrator), one.contacts);
  CHECK(one.outcome == Outcome::finished);
  CHECK(one.contacts > 3);
  for (const double stop : {0.02, 0.0501, 0.09}) {
    parts.options.stop_at = stop;
    parts.options.threads = stop > 0.05 ? 2 : 1;
    CHECK(simulate(parts.cloth, parts.world, parts.options, &parts.state).outcome == Outcome::stopped_at);
  }
  parts.options.stop_at.reset();
  check_same(whole, one, parts, simulate(parts.cloth, parts.world, parts.options, &parts.state));
}

TEST_CASE("simulate: cancelled while it is prepared, it ends as if its observer had stopped it") {
  Cloth cloth = sheet(6, 6, 0.05);
  add_springs_and_masses(cloth, 100, 1, 0.2);
  const std::vector<Vec3> before = cloth.particles.x;
  SimulateOptions options;
  options.integrator = Integrator::leapfrog;
  options.seconds = 0.1;
  int asked = 0;
  const CancelScope scope([&] { return ++asked >= 3; });
  SimulateState state;
  const SimulateReport report = simulate(cloth, World{}, options, &state);
  CHECK(report.outcome == Outcome::stopped_by_observer);
  CHECK(report.steps == 0);
  CHECK(state.step == 0);
  CHECK(cloth.particles.x == before);
}

TEST_CASE("simulate: a step that is cancelled is none, and going on gives the bits of a run that was not",
          "[long]") {
  const Sphere ball(Vec3::Zero(), 0.2);
  Scene whole = busy_scene(ball);
  whole.options.integrator = GENERATE(Integrator::implicit, Integrator::tr_bdf2);
  whole.options.dt = 1.0 / 240;
  whole.options.seconds = 0.1;
  Scene parts = whole;
  const SimulateReport one = simulate(whole.cloth, whole.world, whole.options, &whole.state);
  REQUIRE(one.outcome == Outcome::finished);
  SimulateReport part;
  int stops = 0, within = 0;
  do {
    const Cloth before = parts.cloth;
    const std::int64_t steps = parts.state.step;
    int questions = 0;
    parts.options.threads = 1 + stops % 2;
    const CancelScope scope([&] { return ++questions >= 11 + 7 * (stops % 9); });
    part = simulate(parts.cloth, parts.world, parts.options, &parts.state);
    if (part.outcome == Outcome::finished) break;
    CHECK(part.outcome == Outcome::stopped_by_observer);
    within += parts.state.step == steps;
    if (parts.state.step == steps) CHECK(parts.cloth.particles.v == before.particles.v);
  } while (++stops < 100);
  CHECK(stops > 3);
  CHECK(stops < 100);
  CHECK(within > 0);
  check_same(whole, one, parts, part);
}

TEST_CASE("simulate: a later end divides the rest anew and is hit exactly") {
  const Sphere ball(Vec3::Zero(), 0.2);
  Scene scene = busy_scene(ball);
  scene.options.stop_at = 0.1;
  CHECK(simulate(scene.cloth, scene.world, scene.options, &scene.state).outcome == Outcome::stopped_at);
  CHECK(scene.state.time >= 0.1);
  CHECK(scene.state.time < 0.1 + scene.state.dt);
  scene.options.stop_at.reset();
  scene.options.seconds = 0.4;
  CHECK(simulate(scene.cloth, scene.world, scene.options, &scene.state).time == 0.4);
  scene.options.seconds = 0.3;  // past: nothing to do
  const Cloth before = scene.cloth;
  CHECK(simulate(scene.cloth, scene.world, scene.options, &scene.state).time == 0.4);
  CHECK(scene.cloth.particles.x == before.particles.x);
  scene.options.seconds = 0.5;
  scene.options.dt_factor = 0.3;
  const SimulateReport report = simulate(scene.cloth, scene.world, scene.options, &scene.state);
  CHECK(report.time == 0.5);
  CHECK(report.dt <= 0.3 * report.dt_limit);
}

TEST_CASE("simulate: a state that does not fit is refused and nothing changes") {
  const Sphere ball(Vec3::Zero(), 0.2);
  Scene scene = busy_scene(ball);
  scene.options.stop_at = 0.02;
  simulate(scene.cloth, scene.world, scene.options, &scene.state);
  const Scene start = scene;
  const auto refused = [&](const char* text) {
    CHECK_THROWS_WITH(simulate(scene.cloth, scene.world, scene.options, &scene.state), Catch::Contains(text));
    CHECK(scene.cloth.particles.x == start.cloth.particles.x);
    scene = start;
  };
  scene.state.contact.pop_back();
  refused("181 contact memories for 182 particles");
  scene.state.homes.push_back(Vec3::Zero());
  refused("the state knows 2 moved pins, but there are 1");
  scene.state.compensation.force.pop_back();
  refused("181 forces for 182 particles");
  scene.state.compensation.time_constant = 0;
  refused("time constant = 0");
  scene.state.time = -1;
  refused("time = -1");
  scene.state.steps_left += 3;
  refused("do not lead from");
  scene.state.dt = 0;
  refused("dt = 0");
  scene.state.steps_left = -1;
  refused("steps_left = -1");
  scene.state.homes[0].x() = NAN;
  refused("home is not finite");
}

TEST_CASE("simulate: a cloth that was changed is planned anew") {
  Cloth cloth = sheet(8, 8, 0.05, 0.1, 3);
  pin(cloth.particles, std::vector<int>{0, 7});
  SimulateOptions options;
  options.seconds = 0.4;
  options.stop_at = 0.2;
  SimulateState state;
  const SimulateReport first = simulate(cloth, World{}, options, &state);
  for (Spring& s : cloth.structural) s.stiffness *= 9;  // the limit falls to about a third
  add_particle(cloth, {9, 9, 9}, 1e-4);
  state.planned = false;
  options.stop_at.reset();
  const SimulateReport second = simulate(cloth, World{}, options, &state);
  CHECK(second.time == 0.4);
  CHECK(second.dt_limit < 0.4 * first.dt_limit);
  CHECK(second.dt <= 0.9 * second.dt_limit);
  CHECK(second.steps > 2.5 * first.steps);
  CHECK(second.outcome == Outcome::finished);
}
