// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "tests/physics/body/test_bodies.h"
#include "tests/physics/motion/stepper_runs.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

constexpr double floor_gap = 0.003, earth_pull = 9.81;

struct Slide {
  Vec3 way, v;    ///< mean over the sheet [m], [m/s]
  double height;  ///< farthest of a particle from the gap [m]
};

/// A sheet laid on the floor in a field of gravity that leans by an angle, as on an incline. Explicit Euler
/// needs springs that are soft and damped.
Slide slide(Integrator integrator, double friction, double angle, double dt, double seconds) {
  Cloth cloth = sheet(6, 6, 0.05, 0.2, 5, 1, 0.1);
  for (Vec3& x : cloth.particles.x) x = Vec3(x.x(), floor_gap, -x.y());
  const Floor floor;
  BodyContact contact(floor, {.friction = friction, .gap = floor_gap}, int(cloth.particles.size()));
  const Loads loads{.gravity = earth_pull * Vec3(std::sin(angle), -std::cos(angle), 0),
                    .spring_damping = 0.5};
  const Particles end =
      after(cloth, loads, {integrator}, dt, int(std::lround(seconds / dt)), 1, {.contact = &contact});
  Slide result{Vec3::Zero(), Vec3::Zero(), 0};
  const double n = double(end.size());
  for (std::size_t i = 0; i < end.size(); ++i) {
    result.way += (end.x[i] - cloth.particles.x[i]) / n;
    result.v += end.v[i] / n;
    result.height = std::max(result.height, std::abs(end.x[i].y() - floor_gap));
  }
  return result;
}

constexpr double incline = 3.14159265358979323846 / 6;

/// A step that all take with those springs, explicit Euler too.
double step_of(Integrator integrator) { return integrator == furrow::cases::explicit_euler ? 1e-4 : 5e-4; }

}  // namespace

TEST_CASE("stepper: a sheet rests on a slab with each integrator") {
  const Integrator integrator = GENERATE(from_range(all_integrators));
  const double dt = step_of(integrator);
  const Slide rest = slide(integrator, 0.3, 0, dt, 0.5);
  CAPTURE(int(integrator));
  CHECK(rest.way.norm() < 1e-9);
  CHECK(rest.v.norm() < 1.01 * earth_pull * dt);  // the kick that the next contact takes away
  CHECK(rest.height < 1e-9);
}

TEST_CASE("stepper: a sheet sticks on an incline of 30 degrees with friction 0.6, with each integrator") {
  const Integrator integrator = GENERATE(from_range(all_integrators));
  const double dt = step_of(integrator);
  const Slide rest = slide(integrator, 0.6, incline, dt, 0.5);
  CAPTURE(int(integrator));
  CHECK(rest.way.norm() <
        2 * earth_pull * dt * dt);  // the first step may meet a contact that is not loaded yet
  CHECK(rest.v.norm() < 1.01 * earth_pull * dt);
  CHECK(rest.height < 1e-9);
}

TEST_CASE("stepper: a sheet slides down an incline with friction 0.3 as theory says, with each integrator",
          "[release]") {
  const Integrator integrator = GENERATE(from_range(all_integrators));
  const double dt = step_of(integrator), t = 0.5,
               a = earth_pull * (std::sin(incline) - 0.3 * std::cos(incline));
  const Slide down = slide(integrator, 0.3, incline, dt, t);
  CAPTURE(int(integrator), down.way.x() - a * t * t / 2, down.v.x() - a * t);
  CHECK(std::abs(down.way.x() - a * t * t / 2) < 2 * earth_pull * t * dt);
  CHECK(std::abs(down.v.x() - a * t) < 2 * earth_pull * dt);
  CHECK(std::abs(down.way.y()) < 1e-9);
  const double half = std::abs(slide(integrator, 0.3, incline, dt / 2, t).way.x() - a * t * t / 2);
  CHECK(half < 0.6 * std::abs(down.way.x() - a * t * t / 2) + 1e-9);  // order one or better
}

TEST_CASE("stepper: pins are led with each integrator, and what they hold follows") {
  const Integrator integrator = GENERATE(from_range(all_integrators));
  Cloth cloth = sheet(5, 4, 0.05, 0.1, 3, 1, 0.1);
  pin(cloth.particles, std::vector<int>{0, 4});
  const std::vector<MovedPins> pins{{{0, 4}, uniform_motion({0.4, 0, 0.1}, 2)}};
  const std::vector<Vec3> homes = homes_of(pins, cloth.particles, 0);
  PinLeader leader(pins, homes);
  const double dt = step_of(integrator), seconds = 1;
  const Particles end = after(cloth, {.gravity = Vec3::Zero(), .air_drag = 3, .spring_damping = 0.3},
                              {integrator}, dt, int(std::lround(seconds / dt)), 1, {.pins = &leader});
  CAPTURE(int(integrator));
  const Vec3 way(0.4, 0, 0.1);
  for (const std::size_t i : {0, 4}) {
    CHECK((end.x[i] - cloth.particles.x[i] - way).norm() < 1e-12);
    CHECK((end.v[i] - way).norm() < 1e-9);
  }
  Vec3 mean = Vec3::Zero();
  for (const Vec3& v : end.v) mean += v / double(end.size());
  CHECK(mean.x() > 0.2);
}
