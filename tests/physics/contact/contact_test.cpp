// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/contact/contact.h"

#include <catch2/catch.hpp>

#include "physics/motion/simulate.h"
#include "tests/cases/friction.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::cases;
using namespace furrow::tests;

namespace {

struct Ball : Collider {
  double radius;
  explicit Ball(double r) : radius(r) {}
  SignedDistance at(const Vec3& x) const override { return {x.norm() - radius, x.normalized()}; }
};

SimulateOptions frictional(double friction, double dt) {
  SimulateOptions o;
  o.friction = friction;
  o.dt = dt;
  o.air_drag = 0;
  return o;
}

/// How far a particle that starts at rest on an incline slides in 2 s [m]; and its speed [m/s].
std::pair<double, double> slide(double tan_angle, const SimulateOptions& options, double slope = 1) {
  const Vec3 n = Vec3(-tan_angle, 1, 0).normalized(), down = Vec3(-1, -tan_angle, 0).normalized();
  const Plane plane(n, slope);
  Cloth cloth;
  const Vec3 start = 0.4 * down + options.contact_gap / slope * n + Vec3(0, 0, 0.3);
  add_particle(cloth, start, 1e-4);
  simulate(cloth, &plane, options);
  const Vec3 moved = cloth.particles.x[0] - start;
  CHECK(std::abs(moved.dot(n)) < 1e-9);
  CHECK(std::abs(moved.z()) < 1e-9);
  return {moved.dot(down), cloth.particles.v[0].dot(down)};
}

}  // namespace

TEST_CASE("contact: on an incline friction holds exactly up to its angle and slides as Coulomb says beyond",
          "[long]") {
  const double friction = GENERATE(0.2, 0.3, 0.5, 0.75, 1.0), dt = GENERATE(1.0 / 120, 1e-3, 1e-4);
  CAPTURE(friction, dt);
  const SimulateOptions options = frictional(friction, dt);
  CHECK(std::abs(slide(0.5 * friction, options).first) < 1e-9);
  CHECK(std::abs(slide(0.999 * friction, options).first) < 1e-9);
  for (const double factor : {1.001, 1.2, 2.0}) {
    const double angle = std::atan(factor * friction);
    const double exact = 0.5 * 9.81 * (std::sin(angle) - friction * std::cos(angle)) * 4;
    const auto [distance, speed] = slide(factor * friction, options);
    CHECK(distance == Approx(exact).epsilon(0.01));
    // The second half-kick of gravity is still in the velocity.
    CHECK(speed == Approx(exact).margin(9.81 * dt).epsilon(0.01));
  }
}

TEST_CASE("contact: friction is right where the field's slope is not 1") {
  const SimulateOptions options = frictional(0.5, 1e-4);
  CHECK(std::abs(slide(0.49, options, 0.7).first) < 1e-9);
  const double angle = std::atan(0.8), exact = 2 * 9.81 * (std::sin(angle) - 0.5 * std::cos(angle));
  CHECK(slide(0.8, options, 0.7).first == Approx(exact).epsilon(0.01));
  CHECK(slide(0.8, options, 1.2).first == Approx(exact).epsilon(0.01));
}

TEST_CASE("contact: on an incline a cloth lets go at the angle of friction and does not creep below",
          "[release]") {
  const double friction = GENERATE(0.05, 0.3, 0.75, 1.45), dt = GENERATE(1e-3, 2e-4);
  const double degree = 3.14159265358979323846 / 180, exact = std::atan(friction);
  CHECK(std::abs(incline_threshold(friction, dt) - exact) < 0.02 * degree);
  CHECK(slide_of_sheet(exact - 0.2 * degree, friction, dt) < 1e-9);  // in 2 s
}

TEST_CASE("contact: a strip over a cylinder slips beyond the heavy capstan's length and holds below it",
          "[release]") {
  const double mu = GENERATE(0.2, 0.4), R = 0.1, l1 = 0.2, critical = capstan_length(mu, R, l1);
  const int half_turn = GENERATE(32, 64);
  const Cylinder cylinder(R - 0.003);
  for (const double factor : {0.97, 1.03}) {
    const Slip result = slip(strip_over_cylinder(R, l1, factor * critical, half_turn), cylinder, {mu});
    CHECK(std::abs(result.share - mu) > 0.01 * mu);  // the strip as built knows the closed form, too
    CHECK((result.share > mu) == (factor > 1));
    if (factor < 1) CHECK(result.moved < 1e-6);
    if (factor > 1) CHECK(result.moved > 0.01);
  }
}

TEST_CASE("contact: a tablecloth slips over the rounded edge when enough of it hangs down", "[release]") {
  const double mu = GENERATE(0.2, 0.5), R = 0.02, l1 = 0.2, critical = tablecloth_length(mu, R, l1);
  const RoundedTable table(R - 0.003);
  CHECK(slip(strip_over_edge(R, l1, 0.97 * critical, 16), table, {mu}).moved < 1e-6);
  CHECK(slip(strip_over_edge(R, l1, 1.03 * critical, 16), table, {mu}).moved > 1e-3);
}

TEST_CASE("contact: the closed forms of strips are those of an independent program") {
  CHECK(capstan_length(0.2, 0.05, 0.1) == Approx(0.242723610443).epsilon(1e-11));
  CHECK(capstan_length(0.4, 0.02, 0.05) == Approx(0.237935634653).epsilon(1e-11));
  CHECK(tablecloth_length(0.2, 0.005, 0.2) == Approx(0.0503684288067).epsilon(1e-11));
  CHECK(tablecloth_length(0.8, 0.02, 0.4) == Approx(1.12843409703).epsilon(1e-11));
}

TEST_CASE("contact: a braking particle stops after v^2 / (2 mu g)") {
  const Plane floor(Vec3::UnitY());
  const double dt = GENERATE(1e-3, 1e-4), speed = GENERATE(2.0, 5.0), mu = GENERATE(0.4, 0.8);
  Cloth cloth;
  add_particle(cloth, {0, 0.003, 0}, 1e-4, {speed, 0, 0});
  simulate(cloth, &floor, frictional(mu, dt));
  CHECK(cloth.particles.x[0].x() == Approx(speed * speed / (2 * mu * 9.81)).epsilon(0.005));
  CHECK(std::abs(cloth.particles.v[0].x()) < 1e-12);
}

TEST_CASE("contact: a particle that falls on a floor stays there, without a bounce") {
  const Plane floor(Vec3::UnitY());
  Cloth cloth;
  add_particle(cloth, {0, 0.5, 0}, 1e-4);
  double highest = 0;
  bool landed = false;
  SimulateOptions options = frictional(0.3, GENERATE(2e-3, 2e-4));
  options.observe_steps = 1;
  const auto watch = [&](const SimulateProgress&) {
    const double y = cloth.particles.x[0].y();
    CHECK(y > 0.003 - 1e-9);
    if (landed) highest = std::max(highest, y);
    landed = landed || y < 0.003 + 1e-9;
    return true;
  };
  simulate(cloth, &floor, options, watch);
  CHECK(landed);
  CHECK(highest < 0.003 + 1e-9);
}

TEST_CASE("contact: depth that was there before is pushed out slowly and never enters the velocity") {
  const Plane floor(Vec3::UnitY());
  Cloth cloth;
  add_particle(cloth, {0, -0.007, 0}, 1e-4);
  SimulateOptions options = frictional(0.3, 1e-4);
  options.gravity = Vec3(0, GENERATE(0.0, -9.81), 0);
  options.observe_steps = 1;
  options.seconds = 0.2;
  double before = -0.007, fastest = 0, deepest = 0;
  simulate(cloth, &floor, options, [&](const SimulateProgress& p) {
    const double y = cloth.particles.x[0].y();
    fastest = std::max(fastest, (y - before) / p.dt);
    deepest = std::min(deepest, y - before);
    before = y;
    CHECK(std::abs(cloth.particles.v[0].y()) <= 1.0001 * 9.81 * p.dt / 2);
    return true;
  });
  CHECK(cloth.particles.x[0].y() == Approx(0.003).margin(1e-9));
  CHECK(fastest < 0.1001);
  CHECK(deepest > -1e-9);
}

TEST_CASE("contact: a fast particle does not pass through a thin body") {
  const Ball ball(0.005);
  Cloth cloth;
  add_particle(cloth, {-0.5, 0.001, 0}, 1e-4, {60, 0, 0});
  SimulateOptions options = frictional(0.3, 1e-3);  // 6 cm a step, through 1 cm of body
  options.gravity = Vec3::Zero();
  options.seconds = 0.02;
  options.observe_steps = 1;
  double closest = 1, before_x = -0.5;
  bool passed = false;
  const SimulateReport report = simulate(cloth, &ball, options, [&](const SimulateProgress&) {
    const Vec3& x = cloth.particles.x[0];
    closest = std::min(closest, x.norm());
    passed = passed || (before_x < 0 && x.x() > 0 && std::abs(x.y()) < 0.005);
    before_x = x.x();
    return true;
  });
  CHECK(report.truncated_moves >= 1);
  CHECK_FALSE(passed);
  CHECK(closest > 0.003);
  CHECK(closest < 0.009);
}

TEST_CASE("contact: far particles are not asked for, and what is skipped changes nothing") {
  const Plane floor(Vec3::UnitY());
  Cloth cloth;
  add_particle(cloth, {0, 100, 0}, 1e-4);
  SimulateOptions options = frictional(0.3, 1e-3);
  const SimulateReport report = simulate(cloth, &floor, options);
  CHECK(report.steps == 2000);
  CHECK(report.collider_queries < 10);
  CHECK(cloth.particles.x[0].y() == Approx(100 - 2 * 9.81).epsilon(1e-12));
}

TEST_CASE("contact: it refuses options out of range") {
  const Plane floor(Vec3::UnitY());
  CHECK_THROWS_AS(BodyContact(floor, {.friction = -0.1}, 1), std::invalid_argument);
  CHECK_THROWS_AS(BodyContact(floor, {.gap = 0}, 1), std::invalid_argument);
  CHECK_THROWS_AS(BodyContact(floor, {.recovery_speed = 0}, 1), std::invalid_argument);
}
