// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/contact/rigid_contact.h"

#include <catch2/catch.hpp>

#include "physics/body/posed_collider.h"
#include "physics/motion/simulate.h"
#include "tests/physics/body/test_bodies.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

constexpr double g = 9.81;

SimulateOptions frictional(double friction, double dt, double seconds) {
  SimulateOptions o;
  o.friction = friction;
  o.dt = dt;
  o.seconds = seconds;
  o.air_drag = 0;
  return o;
}

Cloth particle(const Vec3& x, const Vec3& v = Vec3::Zero()) {
  Cloth cloth;
  add_particle(cloth, x, 1e-4, v);
  return cloth;
}

/// A sheet in the plane y = height over the origin.
Cloth lying_sheet(int n, double edge, double height) {
  Cloth cloth = sheet(n, n, edge, 0.1, 3);
  Vec3 centre = Vec3::Zero();
  for (const Vec3& x : cloth.particles.x) centre += x / double(cloth.particles.size());
  for (Vec3& x : cloth.particles.x) x = Vec3(x.x() - centre.x(), height, centre.y() - x.y());
  return cloth;
}

}  // namespace

TEST_CASE("rigid_contact: a belt takes a particle along by mu g until it has the belt's speed") {
  const double mu = GENERATE(0.2, 0.5), dt = GENERATE(1e-3, 2e-4), speed = 1;
  const Floor floor;
  World world;
  world.collider = &floor;
  world.body_motion = uniform_motion({speed, 0, 0}, 3);
  Cloth cloth = particle({0, 0.003, 0});
  SimulateState state;
  const double t = 0.8 * speed / (mu * g);
  simulate(cloth, world, frictional(mu, dt, t), &state);
  CHECK(cloth.particles.x[0].x() == Approx(0.5 * mu * g * t * t).epsilon(0.01));
  CHECK(cloth.particles.v[0].x() == Approx(mu * g * t).epsilon(0.01));
  const SimulateReport report = simulate(cloth, world, frictional(mu, dt, 2), &state);
  CHECK(report.time == 2);
  CHECK(report.contacts == 1);
  CHECK(cloth.particles.v[0].x() == Approx(speed).epsilon(1e-8));
  CHECK(2 * speed - cloth.particles.x[0].x() == Approx(speed * speed / (2 * mu * g)).epsilon(0.01));
  CHECK(cloth.particles.x[0].y() == Approx(0.003).margin(1e-9));
}

TEST_CASE(
    "rigid_contact: a plate that accelerates takes a particle along without slip below mu g, and slips "
    "beyond") {
  // x = D (3 s^2 - 2 s^3) starts with the acceleration 6 D / T^2
  const double mu = 0.4, T = 1, share = GENERATE(0.5, 0.98, 1.5);
  const Floor floor;
  World world;
  world.collider = &floor;
  world.body_motion.keyframes = {{0}, {T, Vec3(share * mu * g * T * T / 6, 0, 0)}};
  Cloth cloth = particle({0, 0.003, 0});
  double worst = 0, speed = 0;
  SimulateOptions options = frictional(mu, 5e-4, 1.2);
  options.observe_steps = 10;
  simulate(cloth, world, options, nullptr, [&](const SimulateProgress& p) {
    const double slip = pose(world.body_motion, p.time).translation.x() - cloth.particles.x[0].x();
    worst = std::max(worst, std::abs(slip));
    if (p.time < 0.2) speed = cloth.particles.v[0].x() / p.time;
    return true;
  });
  if (share < 1) CHECK(worst < 1e-9);
  if (share > 1) {
    CHECK(worst > 1e-3);
    CHECK(speed == Approx(mu * g).epsilon(0.01));
  }
}

TEST_CASE("rigid_contact: a turntable holds a particle while omega^2 r and the ramp stay within mu g") {
  const double mu = 0.5, r = 0.2, rate = GENERATE(4.0, 4.8, 5.2, 8.0);
  const bool holds = rate * rate * r < mu * g;
  const Floor floor;
  World world;
  world.collider = &floor;
  world.body_motion.spin = Spin{Vec3::Zero(), Vec3::UnitY(), rate, 0, 2};
  Cloth cloth = particle({r, 0.003, 0});
  SimulateOptions options = frictional(mu, 5e-4, 2.5);
  options.stop_at = 0.5;
  SimulateState state;
  simulate(cloth, world, options, &state);
  CHECK((pose(world.body_motion, state.time).to_body(cloth.particles.x[0]) - Vec3(r, 0.003, 0)).norm() <
        1e-9);
  options.stop_at.reset();
  CHECK(simulate(cloth, world, options, &state).outcome == Outcome::finished);
  const Vec3 there = pose(world.body_motion, 2.5).to_body(cloth.particles.x[0]);
  if (holds) {
    CHECK((there - Vec3(r, 0.003, 0)).norm() < 1e-9);
    CHECK(cloth.particles.v[0].norm() == Approx(rate * r).epsilon(1e-4));
  } else {
    CHECK(std::hypot(there.x(), there.z()) > 1.05 * r);
  }
}

TEST_CASE("rigid_contact: a spinning ball takes the cloth on it along, by friction alone", "[release]") {
  const double friction = GENERATE(0.0, 0.5), rate = 3;
  const Sphere ball(Vec3::Zero(), 0.2);
  World world;
  world.collider = &ball;
  world.body_motion.spin = Spin{Vec3::Zero(), Vec3::UnitY(), rate, 0.2, 0.3};
  Cloth cloth = lying_sheet(13, 0.04, 0.205);
  SimulateOptions options;
  options.friction = friction;
  options.air_drag = 0.1;
  options.seconds = 2;
  CHECK(simulate(cloth, world, options).outcome == Outcome::finished);
  double momentum = 0, inertia = 0, deepest = -1;
  for (std::size_t i = 0; i < cloth.particles.size(); ++i) {
    const Vec3 &x = cloth.particles.x[i], &v = cloth.particles.v[i];
    momentum += cloth.particles.mass[i] * (x.z() * v.x() - x.x() * v.z());
    inertia += cloth.particles.mass[i] * (x.x() * x.x() + x.z() * x.z());
    deepest = std::max(deepest, 0.2 - x.norm());
  }
  CHECK(deepest < 0);
  if (friction == 0) CHECK(std::abs(momentum / inertia) < 0.01 * rate);
  if (friction > 0) CHECK(momentum / inertia == Approx(rate).epsilon(0.2));
}

TEST_CASE("rigid_contact: a scene that moves and is turned as a whole is the same scene") {
  const Vec3 v(0.7, -0.3, 0.4), turn(0.3, -1.1, 0.6);
  const Eigen::AngleAxisd R(turn.norm(), turn.normalized());
  const Sphere ball(Vec3(0.02, 0.01, 0.03), 0.2);
  SimulateOptions options;
  options.seconds = 0.2;  // buckling makes ten times as much of any difference each 30 ms
  options.dt = 1e-4;
  World here, there;
  here.collider = there.collider = &ball;
  there.body_motion = uniform_motion(v, 2, turn);
  there.wind.velocity = v;
  Cloth cloth = lying_sheet(15, 0.04, 0.213), moved = cloth;
  for (Vec3& x : moved.particles.x) x = R * x;
  for (Vec3& w : moved.particles.v) w = v;
  const SimulateReport a = simulate(cloth, here, options);
  options.gravity = R * options.gravity;
  const SimulateReport b = simulate(moved, there, options);
  CHECK(a.contacts > 15);
  CHECK(b.contacts == a.contacts);
  CHECK(b.strain.max == Approx(a.strain.max).epsilon(1e-6));
  double worst = 0;
  for (std::size_t i = 0; i < cloth.particles.size(); ++i) {
    worst = std::max(worst, (moved.particles.x[i] - R * cloth.particles.x[i] - 0.2 * v).norm());
  }
  INFO("largest difference " << worst);
  CHECK(worst < 1e-7);
}

TEST_CASE("rigid_contact: a body that runs into cloth does not pass through it", "[release]") {
  const double dt = GENERATE(5e-3, 1e-3);  // 25 mm a step, through a plate of 4 mm
  const Slab slab(0.002);
  World world;
  world.collider = &slab;
  world.body_motion = uniform_motion({0, 5, 0}, 2);
  Cloth cloth = particle({0, 0.3, 0});
  SimulateOptions options = frictional(0.3, dt, 0.5);
  options.gravity.setZero();
  options.observe_steps = 1;
  double nearest = 1;
  const SimulateReport report = simulate(cloth, world, options, nullptr, [&](const SimulateProgress& p) {
    nearest = std::min(nearest, pose(world.body_motion, p.time).to_body(cloth.particles.x[0]).y());
    return true;
  });
  CHECK(nearest > 0);
  CHECK(report.truncated_moves >= (dt > 2e-3));
  CHECK(cloth.particles.v[0].y() == Approx(5).epsilon(1e-6));

  const Sphere ball(Vec3::Zero(), 0.1);
  world.collider = &ball;
  world.body_motion = uniform_motion({0, 0, 5}, 2);
  cloth = sheet(25, 25, 0.02, 0.1, 5);
  for (Vec3& x : cloth.particles.x) x += Vec3(-0.25, 0.2, 0.4);
  options = {};
  options.seconds = 0.25;
  options.observe_steps = 1;
  double deepest = 0;
  bool hits = false;
  const SimulateReport hit = simulate(cloth, world, options, nullptr, [&](const SimulateProgress& p) {
    for (const Vec3& x : cloth.particles.x)
      deepest = std::max(deepest, 0.1 - pose(world.body_motion, p.time).to_body(x).norm());
    hits = hits || count_contacts(cloth.particles.x, PosedCollider(ball, pose(world.body_motion, p.time)),
                                  0.003) > 10;
    return true;
  });
  CHECK(hit.outcome == Outcome::finished);
  CHECK(hits);
  CHECK(deepest == 0);
}

TEST_CASE("rigid_contact: a body that stands elsewhere is met there, and far particles are not asked for") {
  const Floor floor;
  World world;
  world.collider = &floor;
  world.body_motion.keyframes = {{0, Vec3(0, 1, 0), Vec3(0, 0.3, 0)}};
  Cloth cloth = particle({0, 1.2, 0});
  const SimulateReport report = simulate(cloth, world, frictional(0.3, 1e-3, 1));
  CHECK(cloth.particles.x[0].y() == Approx(1.003).margin(1e-9));
  CHECK(report.contacts == 1);
  world.body_motion = uniform_motion({3, 0, 0}, 4);
  cloth = particle({0, 100, 0});
  CHECK(simulate(cloth, world, frictional(0.3, 1e-3, 2)).collider_queries < 10);
}
