// SPDX-License-Identifier: GPL-3.0-or-later
// How cloth lands on a body, whichever integrator moves it.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/cases/friction.h"
#include "tests/cases/gravity.h"

using namespace furrow::physics;
namespace cases = furrow::cases;

namespace {

constexpr double degree = 3.14159265358979323846 / 180, landing_friction = 0.37;

SimulateOptions landing(Integrator integrator) {
  SimulateOptions options;
  options.integrator = integrator;
  options.friction = landing_friction;
  return options;
}

}  // namespace

TEST_CASE("landing: below the angle of friction a sheet stays where it lands, above it slides") {
  const Integrator integrator = GENERATE(Integrator::implicit, Integrator::leapfrog);
  const double above = GENERATE(from_range(cases::landing_starts));
  // Leapfrog is the choice for what is soft.
  const double stiffness = integrator == Integrator::leapfrog ? 20 : 1000,
               angle = std::atan(landing_friction);
  CAPTURE(int(integrator), above);
  CHECK(cases::slide_of_landing(19.7 * degree, above, stiffness, landing(integrator)) < 5e-4);
  CHECK(cases::slide_of_landing(angle - 0.2 * degree, above, stiffness, landing(integrator)) < 5e-4);
  CHECK(cases::slide_of_landing(angle + 0.2 * degree, above, stiffness, landing(integrator)) > 5e-3);
}

TEST_CASE("landing: a sheet that lands as it slides stops after v^2 / (2 mu g)") {
  const Integrator integrator = GENERATE(Integrator::implicit, Integrator::leapfrog);
  const double above = GENERATE(from_range(cases::landing_starts)), speed = GENERATE(1.0, 2.0);
  const double stiffness = integrator == Integrator::leapfrog ? 20 : 1000;
  CAPTURE(int(integrator), above, speed);
  CHECK(cases::braking_way(speed, above, stiffness, landing(integrator)) ==
        Approx(speed * speed / (2 * landing_friction * cases::gravity)).epsilon(0.01));
}

TEST_CASE("landing: what starts in the gap is lifted out of it without speed", "[long]") {
  const double above = GENERATE(-2e-3, -1e-3, -1e-4), dt = GENERATE(1.0 / 60, 1.0 / 240, 1e-3, 1e-4);
  const Integrator integrator = GENERATE(Integrator::implicit, Integrator::tr_bdf2);
  SimulateOptions options = landing(integrator);
  Cloth cloth = cases::sheet_over_floor(above, options.contact_gap, 1000);
  const cases::Plane floor(Vec3::UnitY());
  options.dt = dt;
  options.seconds = 0.1;
  options.observe_steps = 1;
  double fastest = 0, highest = 0;
  simulate(cloth, &floor, options, [&](const SimulateProgress&) {
    for (const Vec3& v : cloth.particles.v) fastest = std::max(fastest, v.norm());
    for (const Vec3& x : cloth.particles.x) highest = std::max(highest, x.y());
    return true;
  });
  CAPTURE(above, dt, int(integrator), fastest);
  CHECK(fastest < 0.02);
  CHECK(highest < options.contact_gap + 1e-6);
  for (const Vec3& x : cloth.particles.x) CHECK(x.y() > 0.9 * options.contact_gap);
}
