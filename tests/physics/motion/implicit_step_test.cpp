// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/motion/implicit_step.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "physics/cloth/join_cloths.h"
#include "physics/cloth/pins.h"
#include "physics/rest/settle.h"
#include "tests/physics/body/test_bodies.h"
#include "tests/physics/cloth/shell_cloths.h"
#include "tests/physics/motion/stepper_runs.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

constexpr double earth = 9.81, rest_gap = 0.003;

StepperOptions exactly(Integrator integrator) { return {integrator, {}, {.tolerance = 1e-7, .few = 12}}; }

/// A cloth on a body by simulate().
SimulateReport run(Cloth& cloth, const World& world, Integrator integrator, double dt, double seconds,
                   double friction, const Vec3& gravity = {0, -earth, 0}, const Observer& observer = {}) {
  SimulateOptions o;
  o.integrator = integrator;
  o.dt = dt;
  o.seconds = seconds;
  o.friction = friction;
  o.gravity = gravity;
  o.air_drag = 0;
  o.implicit.tolerance = 1e-4;
  o.observe_steps = 1;
  return simulate(cloth, world, o, nullptr, observer);
}

/// A sheet as it rests in the gap of a floor under a gravity that leans.
Cloth sheet_on_floor(const Collider& floor, double angle) {
  Cloth cloth = sheet(6, 6, 0.05, 0.2, 5, 1000, 10);
  for (Vec3& x : cloth.particles.x) x = Vec3(x.x(), rest_gap, -x.y());
  settle(cloth, &floor, {.gravity = earth * Vec3(std::sin(angle), -std::cos(angle), 0), .friction = 2});
  for (Vec3& v : cloth.particles.v) v.setZero();
  return cloth;
}

Vec3 mean_way(const Cloth& now, const Cloth& start) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < now.particles.size(); ++i) sum += now.particles.x[i] - start.particles.x[i];
  return sum / double(now.particles.size());
}

}  // namespace

TEST_CASE("implicit_step: backward Euler shrinks and turns an oscillator as its theory says") {
  const double z = GENERATE(0.01, 0.1, 0.5, 1.0, 10.0);
  const Cloth start = pendulum(1, 1, 40, {41, 0, 0});
  const Particles end = after(start, {.gravity = Vec3::Zero()}, exactly(Integrator::implicit), z, 1);
  CAPTURE(z);
  // (q, v) = (1, 0) becomes (1, -z) / (1 + z^2).
  CHECK(end.x[1].x() - 40 == Approx(1 / (1 + z * z)).epsilon(1e-9));
  CHECK(end.v[1].x() == Approx(-z / (1 + z * z)).epsilon(1e-9));
}

TEST_CASE("implicit_step: order one of backward Euler and two of TR-BDF2 on the elastic pendulum", "[long]") {
  const Integrator integrator = GENERATE(Integrator::implicit, Integrator::tr_bdf2);
  const Vec3 exact(0.389103045248, -0.920914325687, 0);
  const Cloth cloth = pendulum(0.1, 50, 1, {1.1, 0.2, 0});
  const int coarsest = integrator == Integrator::tr_bdf2 ? 2000 : 8000;
  std::vector<double> errors;
  for (int f = 1; f <= 4; f *= 2) {
    const int steps = f * coarsest;
    errors.push_back((after(cloth, {}, exactly(integrator), 2.0 / steps, steps).x[1] - exact).norm());
  }
  CAPTURE(int(integrator), errors);
  const double order = integrator == Integrator::tr_bdf2 ? 2 : 1;
  CHECK(std::log2(errors[0] / errors[1]) == Approx(order).margin(0.1));
  CHECK(std::log2(errors[1] / errors[2]) == Approx(order).margin(0.1));
}

TEST_CASE("implicit_step: free fall has the right velocity, and the right way but for the first step") {
  const Integrator integrator = GENERATE(Integrator::implicit, Integrator::tr_bdf2);
  const Cloth cloth = pendulum(0.1, 1e-9, 1, {1, 0, 0});
  const double h = 0.01;
  const int steps = 50;
  const Particles end = after(cloth, {}, exactly(integrator), h, steps);
  const double t = h * steps, late = integrator == Integrator::implicit ? h * t : h * h;
  CHECK(end.v[1].y() == Approx(-earth * t).epsilon(1e-8));
  CHECK(end.x[1].y() == Approx(-0.5 * earth * (t * t + late)).epsilon(1e-8));
}

TEST_CASE("implicit_step: a free cloth keeps its momentum") {
  const Integrator integrator = GENERATE(Integrator::implicit, Integrator::tr_bdf2);
  Cloth cloth = swinging_sheet();
  Particles& p = cloth.particles;
  for (std::size_t i = 0; i < p.size(); ++i) p.inv_mass[i] = 1 / p.mass[i];
  const Particles end = after(cloth, {.gravity = Vec3::Zero()}, exactly(integrator), 1.0 / 240, 100);
  Vec3 change = Vec3::Zero();
  double scale = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    change += p.mass[i] * (end.v[i] - p.v[i]);
    scale += p.mass[i] * p.v[i].norm();
  }
  CAPTURE(int(integrator));
  CHECK(change.norm() < 1e-9 * scale);
}

TEST_CASE("implicit_step: below the angle of friction a sheet stays, above it slides as Coulomb says",
          "[long]") {
  const Integrator integrator = GENERATE(Integrator::implicit, Integrator::tr_bdf2);
  const Floor floor;
  const double angle = 3.14159265358979323846 / 6, threshold = std::tan(angle);
  const Vec3 gravity = earth * Vec3(std::sin(angle), -std::cos(angle), 0);
  World world;
  world.collider = &floor;
  const Cloth start = sheet_on_floor(floor, angle);
  CAPTURE(int(integrator));

  Cloth held = start;
  std::vector<double> way;
  run(held, world, integrator, 1.0 / 60, 10, 1.03 * threshold, gravity,
      [&](const SimulateProgress&) { return way.push_back(mean_way(held, start).x()), true; });
  CHECK(std::abs(way[120]) < 5e-4);
  CHECK(std::abs(way.back() - way[120]) < 8e-6);  // less than a micrometre a second

  Cloth sliding = start;
  const double friction = 0.5 * threshold, t = 0.5,
               a = earth * (std::sin(angle) - friction * std::cos(angle));
  const SimulateReport report = run(sliding, world, integrator, 1.0 / 240, t, friction, gravity);
  CHECK(report.open_steps == 0);
  CHECK(mean_way(sliding, start).x() == Approx(0.5 * a * t * t).epsilon(0.02));
  CHECK(std::abs(mean_way(sliding, start).y()) < 5e-4);
}

TEST_CASE("implicit_step: friction takes cloth along on a body that moves and turns") {
  const Integrator integrator = GENERATE(Integrator::implicit, Integrator::tr_bdf2);
  const Floor floor;
  const Cloth start = sheet_on_floor(floor, 0);
  World world;
  world.collider = &floor;
  world.body_motion.spin = Spin{{0.125, 0, -0.125}, Vec3::UnitY(), 2, 0, 0.5};  // omega^2 r < 0.8 m/s^2
  world.body_motion.keyframes = {{0}, {1, Vec3(0.2, 0, 0)}, {2, Vec3(0.2, 0.05, 0)}};
  Cloth cloth = start;
  const SimulateReport report = run(cloth, world, integrator, 1.0 / 60, 2, 0.5);
  const Pose end = pose(world.body_motion, 2);
  double farthest = 0;
  for (std::size_t i = 0; i < cloth.particles.size(); ++i) {
    const Vec3 way = end.to_body(cloth.particles.x[i]) - start.particles.x[i];
    farthest = std::max(farthest, way.norm());
  }
  CAPTURE(int(integrator));
  CHECK(report.open_steps == 0);
  CHECK(farthest < 1e-3);
}

TEST_CASE("implicit_step: what falls on a ball stays out of it at a sixtieth of a second, and comes to rest",
          "[long]") {
  const Sphere ball(Vec3::Zero(), 0.2);
  Cloth cloth = sheet(24, 24, 0.025, 0.2, 3, 200, 0.5);
  for (Vec3& x : cloth.particles.x) x = Vec3(x.x() - 0.29, 0.5, -x.y() - 0.29);
  World world;
  world.collider = &ball;
  SimulateOptions o;
  o.integrator = Integrator::implicit;
  o.seconds = 5;
  double deepest = 0;
  const auto watch = [&](const SimulateProgress&) {
    for (const Vec3& x : cloth.particles.x) deepest = std::max(deepest, rest_gap - ball.at(x).value);
    return true;
  };
  o.observe_steps = 1;
  const SimulateReport report = simulate(cloth, world, o, nullptr, watch);
  CHECK(report.outcome == Outcome::finished);
  CHECK(report.steps == 300);
  CHECK(report.open_steps == 0);
  CHECK(deepest < 1.5 * rest_gap);  // where it falls at 2.4 m/s, 40 mm a step
  CHECK(report.contacts > 20);
  CHECK(report.kinetic_energy < 1e-5);
  CHECK(report.residual_force < 0.3);  // ten times the tolerance
}

/// Two balls with less room between them than cloth keeps from each.
struct Cleft : Collider {
  Sphere left{Vec3(-0.2 - 0.6 * rest_gap, 0, 0), 0.2}, right{Vec3(0.2 + 0.6 * rest_gap, 0, 0), 0.2};
  SignedDistance at(const Vec3& x) const override {
    const SignedDistance a = left.at(x), b = right.at(x);
    return a.value < b.value ? a : b;
  }
};

TEST_CASE("implicit_step: what the body pushes from two sides is given room, and each step is solved") {
  const Integrator integrator = GENERATE(Integrator::implicit, Integrator::tr_bdf2);
  const Cleft cleft;
  Cloth cloth = sheet(8, 8, 0.02, 0.2, 5, 1000, 10);
  for (Vec3& x : cloth.particles.x) x = Vec3(1e-4 * std::sin(40 * x.x()), x.y() + 0.05, x.x() - 0.07);
  pin(cloth.particles, std::vector<int>{0, 7});
  World world;
  world.collider = &cleft;
  const SimulateReport report = run(cloth, world, integrator, 1.0 / 120, 0.3, 0, {0, -earth, 0});
  CAPTURE(int(integrator), report.open_steps, report.iterations);
  CHECK(report.outcome == Outcome::finished);
  CHECK(report.open_steps == 0);
  CHECK(report.iterations < 8 * report.steps);
  for (const Vec3& x : cloth.particles.x) CHECK(cleft.at(x).value > 0.2 * rest_gap);
}

TEST_CASE("implicit_step: cloth that the air presses to a rough body is solved in few iterations", "[long]") {
  const Sphere ball(Vec3::Zero(), 0.2);
  World world;
  world.collider = &ball;
  world.wind.velocity = Vec3(0, 0, -12);
  SimulateOptions o;
  o.integrator = Integrator::implicit;
  o.seconds = 0.5;
  o.friction = 0.6;
  Cloth cloth = sheet(30, 30, 0.02, 0.12, 3, 1000, 0.5);
  for (Vec3& x : cloth.particles.x) x = Vec3(x.x() - 0.3, x.y() + 0.3, 0.205);
  const SimulateReport report = simulate(cloth, world, o);
  CAPTURE(report.iterations, report.contacts);
  CHECK(report.contacts > 100);
  CHECK(report.open_steps == 0);
  CHECK(report.iterations < 8 * report.steps);  // 35 where nothing holds back what slides
}

TEST_CASE("implicit_step: a part that swings is solved beside one that is heavy and calm") {
  const Integrator integrator = GENERATE(Integrator::implicit, Integrator::tr_bdf2);
  const Cloth swings = pendulum(0.1, 5e3, 1, {1, 0, 0});
  const Cloth calm = pendulum(1e5, 1e8, 1, {0, -1 - 1e5 * earth / 1e8, 0});
  const double h = 1.0 / 30;
  const StepperOptions usual{integrator, {}, {}, {}};
  const Particles alone = after(swings, {}, exactly(integrator), h, 15);
  const Particles beside = after(join_cloths(std::array{calm, swings}), {}, usual, h, 15);
  CAPTURE(int(integrator));
  CHECK((beside.x[3] - alone.x[1]).norm() < 0.05);  // 0.12 by the mean alone
}

TEST_CASE("implicit_step: cloth that crumples is not halved for the sake of a few of its particles",
          "[long]") {
  Cloth cloth = without_springs(sheet(40, 40, 0.01, 0.2, 3));
  add_membrane(cloth, 200);
  add_hinges(cloth, 2e-6);
  Noise noise(5);
  for (Vec3& x : cloth.particles.x) x = Vec3(0.4 * x.x(), 0.4 * x.y(), 0.004 * noise());
  pin(cloth.particles, std::vector<int>{0});
  World world;
  world.wind.velocity = Vec3(-4, -9, -6);
  SimulateOptions o;
  o.integrator = Integrator::implicit;
  o.dt = 1.0 / 120;
  o.seconds = 0.4;
  const SimulateReport report = simulate(cloth, world, o, nullptr);
  CAPTURE(report.iterations, report.steps, report.open_steps, report.longest_edge.strain);
  CHECK(report.open_steps <= 1);  // the first one, of a sheet that is squashed to 0.4 of its width
  CHECK(report.longest_edge.strain < 0.5);
  CHECK(report.iterations < 800);  // 1135 if those few halve steps, 1954 if halves are solved finer, too
}

TEST_CASE("implicit_step: calm steps go on with the factors of steps before, and end where others do") {
  const Floor floor;
  World world;
  world.collider = &floor;
  // It lies still, the floor comes up under it, and then drops away from under it.
  world.body_motion.keyframes = {{0}, {0.5}, {0.7, Vec3(0, 0.02, 0)}, {1}, {1.05, Vec3(0, -0.5, 0)}};
  SimulateOptions o;
  o.integrator = Integrator::implicit;
  o.air_drag = 0;
  o.dt = 1.0 / 60;
  const Cloth start = sheet_on_floor(floor, 0);
  double fell = 0, apart = 0;
  for (const double seconds : {0.5, 1.0, 1.2}) {
    o.seconds = seconds;
    std::array<Cloth, 2> ends{start, start};
    std::array<SimulateReport, 2> reports;
    for (const bool keep : {false, true}) {
      o.implicit.keep_factors = keep;
      reports[keep] = simulate(ends[keep], world, o, nullptr);
    }
    for (std::size_t i = 0; i < start.particles.size(); ++i) {
      const Vec3 &a = ends[0].particles.x[i], &b = ends[1].particles.x[i];
      apart = std::max(apart, (a - b).norm());
      fell = start.particles.x[i].y() - b.y();
    }
    CAPTURE(seconds, reports[0].factorisations, reports[1].factorisations);
    CHECK(reports[0].factorisations >= 60 * seconds - 1);
    if (seconds == 0.5) CHECK(reports[1].factorisations <= 10);
    if (seconds == 1.0) CHECK(reports[1].factorisations < 0.8 * reports[0].factorisations);
    CHECK(reports[1].open_steps == 0);
  }
  CHECK(fell > 0.08);  // what is pushed no more is not held in the air
  CHECK(apart < 2e-3);
}

TEST_CASE("implicit_step: options out of their range are refused") {
  const Cloth cloth = pendulum(0.1, 50, 1, {1.1, 0.2, 0});
  ThreadPool pool(1);
  Motion motion(cloth, {}, pool);
  CHECK_THROWS_WITH(make_stepper(motion, {Integrator::implicit, {}, {.tolerance = 0}}),
                    Catch::Contains("implicit step: tolerance"));
  CHECK_THROWS_WITH(make_stepper(motion, {Integrator::tr_bdf2, {}, {.few = 0}}),
                    Catch::Contains("implicit step: few"));
  CHECK_THROWS_AS(make_stepper(motion, {Integrator::implicit})->step(0), std::invalid_argument);
}
