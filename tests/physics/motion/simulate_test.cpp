// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/motion/simulate.h"

#include <catch2/catch.hpp>

#include "physics/body/moving_body.h"
#include "physics/cloth/pins.h"
#include "tests/physics/motion/hung_sheet.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

constexpr double gravity = 9.81;

struct Ball : Collider {
  Vec3 centre;
  double radius;
  Ball(const Vec3& c, double r) : centre(c), radius(r) {}
  SignedDistance at(const Vec3& x) const override {
    return {(x - centre).norm() - radius, (x - centre).normalized()};
  }
};

bool same_bits(const Cloth& a, const Cloth& b) {
  return a.particles.x == b.particles.x && a.particles.v == b.particles.v;
}

}  // namespace

TEST_CASE("simulate: two runs, and runs with one and two threads, give the same bits", "[long]") {
  Cloth first = sheet(60, 55, 0.02, 0.2, 2);  // several blocks
  pin(first.particles, std::vector<int>{0, 59});
  Cloth second = first, third = first;
  const Ball ball({0.6, -0.5, -0.202}, 0.2);
  SimulateOptions options;
  options.seconds = 0.004;
  options.dt = 2e-5;
  options.observe_steps = 60;
  int seen = 0;
  const SimulateReport report =
      simulate(first, &ball, options, [&](const SimulateProgress&) { return ++seen > 0; });
  CHECK(seen == 4);
  CHECK(report.contacts > 0);
  simulate(second, &ball, options);
  CHECK(same_bits(first, second));
  options.threads = 2;
  const SimulateReport two = simulate(third, &ball, options);
  CHECK(same_bits(first, third));
  CHECK(two.collider_queries == report.collider_queries);
}

TEST_CASE("simulate: an undamped hung sheet keeps its energy, a damped one comes to rest") {
  Cloth cloth = hung_sheet();
  const auto energy = [&] {
    double e = kinetic_energy(cloth.particles);
    for (std::size_t i = 0; i < cloth.particles.size(); ++i) {
      e += cloth.particles.mass[i] * gravity * cloth.particles.x[i].y();
    }
    for (const auto* springs : {&cloth.structural, &cloth.bending}) {
      for (const Spring& s : *springs) {
        e += 0.5 * s.stiffness *
             std::pow((cloth.particles.x[s.a] - cloth.particles.x[s.b]).norm() - s.rest_length, 2);
      }
    }
    return e;
  };
  double scale = 0;
  for (const double m : cloth.particles.mass) scale += m * gravity * 0.43;
  SimulateOptions options;
  options.seconds = 1;
  SECTION("undamped") {
    options.air_drag = options.spring_damping = 0;
    const double start = energy();
    double worst = 0;
    simulate(cloth, nullptr, options, [&](const SimulateProgress&) {
      worst = std::max(worst, std::abs(energy() - start));
      return true;
    });
    CHECK(worst > 0);
    CHECK(worst < 2e-3 * scale);
  }
  SECTION("damped") {
    options.seconds = 8;
    options.air_drag = 4;
    options.spring_damping = 0.1;
    const SimulateReport report = simulate(cloth, nullptr, options);
    CHECK(report.outcome == Outcome::finished);
    CHECK(report.kinetic_energy < 1e-8 * scale);
    CHECK(report.residual_force < 0.05);
    CHECK(report.strain.max < 0.2);
    CHECK(report.strain.mean > 0);
  }
}

TEST_CASE("simulate: a sheet that drops on a ball lies on it, and its energy never rises", "[long]") {
  Cloth cloth = sheet(13, 15, 0.05, 0, 1);
  const double R = 0.2;
  Vec3 centre = Vec3::Zero();
  for (const Vec3& x : cloth.particles.x) centre += x / double(cloth.particles.size());
  for (Vec3& x : cloth.particles.x) x = Vec3(x.x() - centre.x(), R + 0.05, x.y() - centre.y());
  const Ball ball(Vec3::Zero(), R);
  SimulateOptions options;
  options.seconds = 1;
  options.observe_steps = 1;
  double before = 1e300, rise = 0, mgh = 0, deepest = 0;
  for (const double m : cloth.particles.mass) mgh += m * gravity * (R + 0.05);
  const SimulateReport report = simulate(cloth, &ball, options, [&](const SimulateProgress& p) {
    double e = p.kinetic_energy;
    for (std::size_t i = 0; i < cloth.particles.size(); ++i) {
      e += cloth.particles.mass[i] * gravity * cloth.particles.x[i].y();
      deepest = std::max(deepest, R + options.contact_gap - cloth.particles.x[i].norm());
    }
    for (const auto* springs : {&cloth.structural, &cloth.bending}) {
      for (const Spring& s : *springs) {
        e += 0.5 * s.stiffness *
             std::pow((cloth.particles.x[s.a] - cloth.particles.x[s.b]).norm() - s.rest_length, 2);
      }
    }
    rise = std::max(rise, e - before);
    before = e;
    return true;
  });
  CHECK(report.outcome == Outcome::finished);
  CHECK(report.contacts >= 5);
  CHECK(deepest < 1e-3 * R);
  CHECK(rise < 1e-3 * mgh);
  INFO("rise relative to m g H: " << rise / mgh);
  CHECK(rise < 1e-5 * mgh);
}

TEST_CASE("simulate: an observer stops a run, and the next call goes on from there") {
  Cloth whole = hung_sheet(), parts = whole;
  SimulateOptions options;
  options.seconds = 0.1;
  options.dt = 1e-4;
  simulate(whole, nullptr, options);
  options.observe_steps = 250;
  const SimulateReport first =
      simulate(parts, nullptr, options, [](const SimulateProgress& p) { return p.step < 500; });
  CHECK(first.outcome == Outcome::stopped_by_observer);
  CHECK(first.steps == 500);
  CHECK(first.time == Approx(0.05).epsilon(1e-12));
  options.seconds = 0.05;
  const SimulateReport second = simulate(parts, nullptr, options);
  CHECK(second.outcome == Outcome::finished);
  CHECK(second.time == 0.05);
  double difference = 0;
  for (std::size_t i = 0; i < whole.particles.size(); ++i) {
    difference = std::max(difference, (whole.particles.x[i] - parts.particles.x[i]).norm());
  }
  CHECK(difference < 1e-10);
}

TEST_CASE("simulate: the step follows the limit and a longer one is refused unless forced") {
  Cloth cloth = hung_sheet();
  const Cloth start = cloth;
  SimulateOptions options;
  options.seconds = 0.3;
  options.limit_steps = 500;
  const SimulateReport report = simulate(cloth, nullptr, options);
  CHECK(report.time == 0.3);
  CHECK(report.dt <= 0.9 * report.dt_limit * (1 + 1e-9));
  CHECK(report.dt_smallest <= report.dt);
  CHECK(report.limit_estimates >= 2);
  CHECK(report.force_evaluations == report.steps + 1);

  cloth = start;
  options.dt = 1.5 * report.dt_limit;
  CHECK_THROWS_WITH(simulate(cloth, nullptr, options),
                    Catch::Contains("dt = ") && Catch::Contains("above the stability limit of "));
  CHECK(same_bits(cloth, start));
  options.step_rule = StepRule::forced;
  const SimulateReport forced = simulate(cloth, nullptr, options);
  CHECK(forced.outcome == Outcome::diverged);
  CHECK(forced.time < 0.3);
  CHECK(forced.dt == Approx(*options.dt).epsilon(0.02));
}

TEST_CASE("simulate: pinned and isolated particles do not move") {
  Cloth cloth = hung_sheet();
  cloth.particles.v[0] = Vec3(1, 1, 1);
  add_particle(cloth, {1, 2, 3}, 0);
  const Vec3 corner = cloth.particles.x[0];
  SimulateOptions options;
  options.seconds = 0.05;
  CHECK(simulate(cloth, nullptr, options).outcome == Outcome::finished);
  CHECK(cloth.particles.x[0] == corner);
  CHECK(cloth.particles.x.back() == Vec3(1, 2, 3));
}

TEST_CASE("simulate: it refuses options out of range before it moves anything") {
  Cloth cloth = hung_sheet();
  const Cloth start = cloth;
  const auto refused = [&](auto change) {
    SimulateOptions options;
    change(options);
    CHECK_THROWS_AS(simulate(cloth, nullptr, options), std::invalid_argument);
    CHECK(same_bits(cloth, start));
  };
  refused([](SimulateOptions& o) { o.seconds = -1; });
  refused([](SimulateOptions& o) { o.dt = 0; });
  refused([](SimulateOptions& o) { o.dt_factor = 1.1; });
  refused([](SimulateOptions& o) { o.step_rule = StepRule::forced; });
  refused([](SimulateOptions& o) { o.limit_steps = 0; });
  refused([](SimulateOptions& o) { o.air_drag = -1; });
  refused([](SimulateOptions& o) { o.threads = 0; });
  refused([](SimulateOptions& o) { o.integrator = Integrator::xpbd, o.xpbd.iterations = 0; });
  refused([](SimulateOptions& o) { o.observe_steps = 0; });
  refused([](SimulateOptions& o) { o.speed_limit = 0; });
  SimulateOptions none;
  none.seconds = 0;
  CHECK(simulate(cloth, nullptr, none).steps == 0);
  CHECK(same_bits(cloth, start));
}

TEST_CASE("simulate: surroundings that do nothing change no bit") {
  const Ball ball({0.3, -0.3, -0.16}, 0.2);
  Cloth plain = hung_sheet(), still = plain;
  SimulateOptions options;
  options.seconds = 0.2;
  const SimulateReport a = simulate(plain, &ball, options);
  World world;
  world.collider = &ball;
  world.body_motion.keyframes = {{0}, {0.1}};
  world.body_motion.spin = Spin{};
  world.wind.gusts = {{0, 5}};
  SimulateState state;
  const SimulateReport b = simulate(still, world, options, &state);
  CHECK(a.contacts > 0);
  CHECK(same_bits(plain, still));
  CHECK(a.collider_queries == b.collider_queries);
  CHECK(state.time == 0.2);
  CHECK(state.step == b.steps);
}

TEST_CASE("simulate: wind without drag is no wind") {
  Cloth calm = hung_sheet(), windy = calm;
  SimulateOptions options;
  options.seconds = 0.05;
  options.air_drag = 0;
  World world;
  simulate(calm, world, options);
  world.wind.velocity = Vec3(0, 0, 5);
  simulate(windy, world, options);
  CHECK(same_bits(calm, windy));
  options.air_drag = 1;
  simulate(windy, world, options);
  CHECK(windy.particles.v.back().z() > 0.1);
}

TEST_CASE("simulate: one body at a time") {
  const Ball ball(Vec3::Zero(), 0.2);
  AnimatedBody body({{{0, 1, 2}}, {0, 1}, [](int) {
                       return std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
                     }});
  World world;
  world.collider = &ball;
  world.animated = &body;
  Cloth cloth = hung_sheet();
  CHECK_THROWS_WITH(simulate(cloth, world, SimulateOptions{}),
                    Catch::Contains("a rigid and an animated body"));
}
