// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/motion/compensation.h"

#include <catch2/catch.hpp>
#include <limits>

#include "physics/cloth/pins.h"
#include "physics/motion/simulate.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A square stretched by 5 % between four pinned corners, with a free vertex in its middle; `inserted`: with
/// one more in the middle of the spring from corner 0, whose rest length is split.
Cloth square(bool inserted) {
  Cloth cloth;
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0), Vec3(0.5, 0.5, 0)})
    add_particle(cloth, x, 0.01);
  for (int i = 0; i < 4; ++i) cloth.structural.push_back({i, 4, std::sqrt(0.5) / 1.05, 100});
  if (inserted) {
    add_particle(cloth, Vec3(0.26, 0.25, 0), 0.003);
    const double half = cloth.structural[0].rest_length / 2;
    cloth.structural[0] = {0, 5, half, 150};
    cloth.structural.push_back({4, 5, half, 150});
  }
  pin(cloth.particles, std::vector<int>{0, 1, 2, 3});
  return cloth;
}

double farthest_moved(const Cloth& cloth, const Cloth& start) {
  double most = 0;
  for (std::size_t i = 0; i < start.particles.size(); ++i)
    most = std::max(most, (cloth.particles.x[i] - start.particles.x[i]).norm());
  return most;
}

}  // namespace

TEST_CASE("compensation: the force jump sums to nothing, and with gravity to the weight that was added") {
  const Cloth before = square(false), after = square(true);
  const std::vector<Vec3> jump = force_jump(before, after);
  REQUIRE(jump.size() == 6);
  Vec3 sum = Vec3::Zero();
  for (const Vec3& f : jump) sum += f;
  CHECK(sum.norm() < 1e-13);
  CHECK(jump[1] == Vec3::Zero());
  CHECK(jump[4].norm() > 0.1);
  CHECK(jump[5].norm() > 0.1);
  sum.setZero();
  for (const Vec3& f : force_jump(before, after, {0, -10, 0})) sum += f;
  CHECK((sum - Vec3(0, -0.03, 0)).norm() < 1e-13);
  CHECK_THROWS_AS(force_jump(after, before), std::invalid_argument);
}

TEST_CASE("compensation: an equilibrium stays one after an insertion while its forces are compensated") {
  const Vec3 gravity = GENERATE(Vec3(0, 0, 0), Vec3(0, -9.81, 0));
  Cloth before = square(false);
  SimulateOptions options;
  options.gravity = gravity;
  options.seconds = 30;
  simulate(before, nullptr, options);  // to rest
  Cloth after = square(true);
  after.particles.x[4] = before.particles.x[4];
  for (Vec3& v : after.particles.v) v.setZero();
  const Cloth start = after;
  SimulateState state;
  state.compensation.time_constant = infinity;
  add(state.compensation, force_jump(before, after, gravity), 0);
  options.seconds = 1;
  options.air_drag = options.spring_damping = 0;
  const SimulateReport kept = simulate(after, World{}, options, &state);
  CHECK(kept.compensation_left == 1);
  CHECK((kept.compensation_force - Vec3(-0.003 * gravity)).norm() < 1e-12);
  CHECK(farthest_moved(after, start) < 1e-12);

  Cloth loose = start;
  CHECK(simulate(loose, World{}, options).outcome == Outcome::finished);
  CHECK(farthest_moved(loose, start) > 1e-3);
}

TEST_CASE("compensation: it decays as set and is then forgotten") {
  // One free particle, m v' = -f exp(-t / tau): v = -f tau (1 - exp(-t/tau)) / m
  Cloth cloth;
  add_particle(cloth, Vec3::Zero(), 0.5);
  SimulateOptions options;
  options.gravity.setZero();
  options.air_drag = 0;
  options.dt = 1e-3;
  options.seconds = 0.2;
  SimulateState state;
  CHECK(state.compensation.time_constant == 0.3);
  state.compensation.force = {Vec3(0, 2, 0)};
  const SimulateReport report = simulate(cloth, World{}, options, &state);
  CHECK(cloth.particles.v[0].y() == Approx(-2 * 0.3 * (1 - std::exp(-0.2 / 0.3)) / 0.5).epsilon(1e-5));
  CHECK(report.compensation_left == Approx(std::exp(-0.2 / 0.3)));
  CHECK(report.compensation_force.y() == Approx(-2 * std::exp(-0.2 / 0.3)));
  options.seconds = 6;  // 20 tau
  simulate(cloth, World{}, options, &state);
  CHECK(state.compensation.force.size() == 1);
  options.seconds = 6.3;
  CHECK(simulate(cloth, World{}, options, &state).compensation_left == 0);
  CHECK(state.compensation.force.empty());
  CHECK(cloth.particles.v[0].y() == Approx(-2 * 0.3 / 0.5).epsilon(1e-5));
}

TEST_CASE("compensation: what is left of earlier forces goes on under a new jump") {
  Compensation c;
  c.time_constant = 0.5;
  add(c, {Vec3(1, 0, 0)}, 1);
  add(c, {Vec3(0, 1, 0), Vec3(0, 0, 1)}, 1.5);
  CHECK(c.start == 1.5);
  CHECK((c.force[0] - Vec3(std::exp(-1.0), 1, 0)).norm() < 1e-15);
  CHECK(c.force[1] == Vec3(0, 0, 1));
  CHECK((net_force(c, 1.5) + Vec3(std::exp(-1.0), 1, 1)).norm() < 1e-15);
  CHECK(share_left(c, 1.5 + 0.5 * 20.8) == 0);
  CHECK_THROWS_AS(add(c, {Vec3::Zero()}, 2), std::invalid_argument);
  CHECK_THROWS_AS(check(c, 3), std::invalid_argument);
}
