// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>

#include "physics/cloth/pins.h"
#include "physics/motion/simulate.h"
#include "physics/pairs/edge_face_crossings.h"
#include "tests/cases/handled_sheets.h"
#include "tests/physics/body/test_bodies.h"
#include "tests/physics/cloth/test_cloths.h"
#include "tests/physics/motion/stacked_sheets.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

/// A sheet that hangs by its corners, and a smaller one that falls onto it, in two drops that fold it.
Cloth falling_sheets() {
  Cloth cloth = level_sheet(0.3, 8, 0, 0, 3);
  std::vector<int> corners;
  for (std::size_t i = 0; i < cloth.particles.size(); ++i) {
    const Vec3& x = cloth.particles.x[i];
    if (std::min(x.x(), 0.3 - x.x()) < 0.02 && std::min(x.y(), 0.3 - x.y()) < 0.02) corners.push_back(int(i));
  }
  pin(cloth.particles, corners);
  put_over(cloth, level_sheet(0.2, 6, 0.03, 0.06, 4));
  return cloth;
}

SimulateOptions falling(Integrator integrator, bool self) {
  SimulateOptions o;
  o.integrator = integrator;
  o.gravity = {0, 0, -9.81};
  o.seconds = 0.4;
  o.self.on = self;
  o.observe_steps = 1;
  return o;
}

std::size_t crossings_of(const Cloth& cloth) {
  return edge_face_crossings(pair_mesh(cloth, 1e-3), cloth.particles.x).size();
}

}  // namespace

TEST_CASE("self_contact: where nothing is near a motion has the same bits as without") {
  const Integrator integrator =
      GENERATE(Integrator::implicit, Integrator::tr_bdf2, Integrator::leapfrog, Integrator::rk4);
  Cloth without = level_sheet(0.3, 8, 0, 0, 5);
  pin(without.particles, std::vector<int>{0, 8});
  Cloth with = without;
  SimulateOptions o = falling(integrator, false);
  o.seconds = 0.15;
  const SimulateReport a = simulate(without, nullptr, o);
  o.self.on = true;
  const SimulateReport b = simulate(with, nullptr, o);
  CHECK(b.self.on);
  CHECK(b.self.pairs == 0);
  CHECK(a.factorisations == b.factorisations);
  CHECK(without.particles.x == with.particles.x);
  CHECK(without.particles.v == with.particles.v);
}

TEST_CASE("self_contact: a sheet that falls onto another never passes through it", "[long]") {
  const Integrator integrator =
      GENERATE(Integrator::implicit, Integrator::tr_bdf2, Integrator::leapfrog, Integrator::rk4);
  Cloth cloth = falling_sheets();
  std::size_t crossed = 0;
  const SimulateReport report =
      simulate(cloth, nullptr, falling(integrator, true), [&](const SimulateProgress&) {
        crossed += crossings_of(cloth);
        return true;
      });
  CAPTURE(int(integrator), report.open_steps);
  CHECK(report.outcome == Outcome::finished);
  CHECK(crossed == 0);
  CHECK(report.self.pairs > 3);
  CHECK(report.self.nearest > 0);
  CHECK(report.self.nearest < 1.0001e-3);
  CHECK(report.self.crossed_at_start == 0);

  Cloth through = falling_sheets();
  simulate(through, nullptr, falling(integrator, false));
  CHECK(through.particles.x.back().z() < cloth.particles.x.back().z() - 0.1);
}

TEST_CASE("self_contact: stopped and resumed, on one thread or two, it has the same bits", "[long]") {
  const Integrator integrator = GENERATE(Integrator::implicit, Integrator::leapfrog);
  Cloth whole = falling_sheets(), parts = whole;
  SimulateOptions o = falling(integrator, true);
  o.seconds = 0.3;
  const SimulateReport at_once = simulate(whole, nullptr, o);
  CHECK(at_once.self.pairs > 0);
  SimulateState state;
  o.threads = 2;
  for (const double stop : {0.1, 0.17, 0.2, 0.25, 1.0}) {
    o.stop_at = stop;
    simulate(parts, World{}, o, &state);
  }
  CHECK(state.steps.self.stiffness > 0);
  CHECK(whole.particles.x == parts.particles.x);
  CHECK(whole.particles.v == parts.particles.v);
}

TEST_CASE("self_contact: pins that pull a sheet through a held one end blocked, and nothing crosses",
          "[long]") {
  const Integrator integrator = GENERATE(Integrator::implicit, Integrator::leapfrog);
  Cloth cloth = level_sheet(0.3, 6, 0, 0, 3);
  std::vector<int> held;
  for (std::size_t i = 0; i < cloth.particles.size(); ++i) held.push_back(int(i));
  put_over(cloth, level_sheet(0.2, 5, 0.02, 0.06, 4));
  const int led = int(held.size()) + 14;
  held.push_back(led);
  pin(cloth.particles, held);
  World world;
  RigidMotion down;
  down.keyframes = {{0}, {0.4, Vec3(0, 0, -0.06)}};
  world.pins = {{{led}, down}};
  std::size_t crossed = 0;
  SimulateState state;
  const SimulateReport report =
      simulate(cloth, world, falling(integrator, true), &state, [&](const SimulateProgress&) {
        crossed += crossings_of(cloth);
        return true;
      });
  CHECK(report.outcome == Outcome::blocked);
  CHECK(report.time > 0.03);
  CHECK(report.time < 0.3);
  CHECK((report.blocked_at - cloth.particles.x[std::size_t(led)]).norm() < 0.01);
  CHECK(crossed == 0);
  CHECK(crossings_of(cloth) == 0);
}

TEST_CASE("self_contact: steps that solve contact wring a towel by equal torques, and none crosses",
          "[release]") {
  furrow::cases::Handling how;
  how.integrator = Integrator::implicit;
  how.columns = 10;
  how.look = 1;
  how.seconds = 3;
  how.friction = 0;
  const furrow::cases::Handled wrung = furrow::cases::wring(1.5, how);
  CHECK(wrung.report.outcome == Outcome::finished);
  CHECK(wrung.most_crossings == 0);
  CHECK(10 * wrung.report.open_steps < wrung.report.steps);  // one, as built here
  CHECK(wrung.report.self.pairs > 50);
  CHECK(std::abs(wrung.torques[0]) > 1e-3);
  CHECK(wrung.torques[0] == Approx(-wrung.torques[1]).epsilon(0.05));
}

TEST_CASE("self_contact: where cloth is in the way of pins it goes out of it", "[release]") {
  furrow::cases::Handling how;
  how.integrator = Integrator::implicit;
  how.columns = 8;
  how.look = 1;
  how.friction = 0;
  const furrow::cases::Handled wrung =
      furrow::cases::wring(4, how);  // an end turns through a pleat before it
  CHECK(wrung.report.outcome == Outcome::finished);
  CHECK(wrung.most_crossings == 0);
}

TEST_CASE("self_contact: thickness 0, friction below 0 and a cloth without triangles are refused") {
  Cloth cloth = level_sheet(0.1, 3, 0, 0, 1);
  SimulateOptions o = falling(Integrator::leapfrog, true);
  o.self.thickness = 0;
  CHECK_THROWS_WITH(simulate(cloth, nullptr, o), Catch::Contains("thickness"));
  o.self.thickness = 1e-3;
  o.self.friction = -0.1;
  CHECK_THROWS_WITH(simulate(cloth, nullptr, o), Catch::Contains("friction"));
  o.self.friction = 0;
  cloth.triangles.clear();
  CHECK_THROWS_WITH(simulate(cloth, nullptr, o), Catch::Contains("triangles"));
}
