// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/motion/energy_balance.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "physics/cloth/elements.h"
#include "physics/rest/settle.h"
#include "tests/physics/body/test_bodies.h"
#include "tests/physics/motion/stepper_runs.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

constexpr double g = 9.81, gap = 0.003;  // m/s^2, m

/// Of particles that can move, and of the elements [J]; weight against the origin.
double total_energy(const Cloth& cloth, const Vec3& gravity) {
  double energy = potential_energy(cloth, cloth.particles.x);
  const Particles& p = cloth.particles;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.inv_mass[i] > 0) energy += p.mass[i] * (0.5 * p.v[i].squaredNorm() - gravity.dot(p.x[i]));
  return energy;
}

SimulateOptions options_of(Integrator integrator, double dt, double seconds) {
  SimulateOptions o;
  o.integrator = integrator;
  o.dt = dt;
  o.seconds = seconds;
  o.air_drag = 0;
  o.implicit.tolerance = 1e-5;
  return o;
}

Cloth lying_sheet(const Collider& floor) {
  Cloth cloth = sheet(6, 6, 0.05, 0.2, 5, 1000, 10);
  for (Vec3& x : cloth.particles.x) x = Vec3(x.x(), gap, -x.y());
  settle(cloth, &floor, {.friction = 2});
  for (Vec3& v : cloth.particles.v) v.setZero();
  return cloth;
}

double mass_of(const Cloth& cloth) {
  double mass = 0;
  for (const double m : cloth.particles.mass) mass += m;
  return mass;
}

}  // namespace

TEST_CASE("energy_balance: backward Euler takes from an oscillator what its theory says") {
  const double z = 0.3;  // omega dt
  const int steps = 20;
  Cloth cloth = pendulum(1, 1, 40, {41, 0, 0});
  SimulateOptions o = options_of(Integrator::implicit, z, steps * z);
  o.gravity.setZero();
  o.implicit = {.tolerance = 1e-9, .few = 12};
  const EnergyBalance e = simulate(cloth, nullptr, o).energy;
  const double left = 0.5 * std::pow(1 + z * z, -steps);
  CHECK(e.seconds == Approx(steps * z));
  CHECK(e.to_steps() == Approx(0.5 - left).epsilon(1e-8));
  CHECK(e.kinetic + e.elastic == Approx(left - 0.5).epsilon(1e-8));
  CHECK(e.given() == 0);
}

TEST_CASE("energy_balance: what cloth has gained is what was given less what was lost", "[long]") {
  const Integrator integrator = GENERATE(Integrator::implicit, Integrator::tr_bdf2);
  const Sphere ball(Vec3::Zero(), 0.2);
  Cloth cloth = sheet(12, 12, 0.05, 0.2, 3, 200, 0.5);
  for (Vec3& x : cloth.particles.x) x = Vec3(x.x() - 0.29, 0.25, -x.y() - 0.29);
  World world;
  world.collider = &ball;
  world.body_motion.spin = Spin{Vec3::Zero(), Vec3::UnitY(), 3, 0, 0.1};
  world.wind.velocity = {3, 0, 1};
  SimulateOptions o = options_of(integrator, 1.0 / 60, 0.5);
  o.air_drag = 2;
  const double before = total_energy(cloth, o.gravity);
  const EnergyBalance e = simulate(cloth, world, o).energy;
  const double gained = total_energy(cloth, o.gravity) - before;
  CAPTURE(int(integrator), e.by_air, e.by_body, e.to_air, e.to_contact, e.to_steps());
  CHECK(e.kinetic + e.elastic + e.weight == Approx(gained).epsilon(1e-9));
  CHECK(e.given() - e.lost() == Approx(gained).epsilon(1e-9));
  CHECK(e.by_air > 0);
  CHECK(e.by_body > 0);
  CHECK(e.by_pins == 0);
  CHECK(e.to_air > 0);
  CHECK(e.to_contact > 0);
  if (integrator == Integrator::implicit)
    CHECK(e.to_steps() > 0);
  else
    CHECK(std::abs(e.to_steps()) < 0.4 * (e.to_air + e.to_contact));  // what lands does not bounce
}

TEST_CASE(
    "energy_balance: a sheet that slides loses to friction what Coulomb takes, and little to the steps") {
  const Integrator integrator = GENERATE(Integrator::implicit, Integrator::tr_bdf2);
  const Floor floor;
  Cloth cloth = lying_sheet(floor);
  const double speed = 1, friction = 0.4, t = 0.1, way = speed * t - 0.5 * friction * g * t * t;
  for (Vec3& v : cloth.particles.v) v = {speed, 0, 0};
  World world;
  world.collider = &floor;
  SimulateOptions o = options_of(integrator, 1.0 / 240, t);
  o.friction = friction;
  const double mass = mass_of(cloth);
  const EnergyBalance e = simulate(cloth, world, o).energy;
  CAPTURE(int(integrator), e.to_steps());
  CHECK(e.to_contact == Approx(friction * mass * g * way).epsilon(0.03));
  CHECK(std::abs(e.to_steps()) < 0.03 * e.to_contact);
  CHECK(e.by_body == 0);
}

TEST_CASE("energy_balance: a floor that begins to move gives what the cloth on it gains") {
  const Floor floor;
  Cloth cloth = lying_sheet(floor);
  World world;
  world.collider = &floor;
  world.body_motion.keyframes = {{0}, {1, Vec3(0.5, 0, 0)}};
  SimulateOptions o = options_of(Integrator::tr_bdf2, 1.0 / 120, 0.25);
  o.friction = 1;
  const EnergyBalance e = simulate(cloth, world, o).energy;
  CAPTURE(e.to_contact, e.to_steps());
  CHECK(e.kinetic > 1e-3);
  CHECK(e.by_body == Approx(e.kinetic).epsilon(0.05));
}

TEST_CASE(
    "energy_balance: drag takes what theory says, and TR-BDF2 keeps a swing that backward Euler damps") {
  Cloth falling = pendulum(0.1, 1e-9, 1, {1, 0, 0});
  SimulateOptions o = options_of(Integrator::tr_bdf2, 1.0 / 240, 1);
  o.air_drag = 2;
  const EnergyBalance fall = simulate(falling, nullptr, o).energy;
  // v = g (1 - e^-ct) / c: the integral of m c v^2.
  const double c = 2, u = g / c;
  const double lost = 0.1 * c * u * u * (1 - 2 * (1 - std::exp(-c)) / c + (1 - std::exp(-2 * c)) / (2 * c));
  CHECK(fall.to_air == Approx(lost).epsilon(2e-3));
  CHECK(std::abs(fall.to_steps()) < 0.01 * lost);

  double to_steps[2];
  for (const bool second_order : {false, true}) {
    Cloth swing = sheet(9, 9, 0.05, 0.2, 3, 200, 0.5);
    for (Vec3& x : swing.particles.x) x = Vec3(x.x(), 0, -x.y());
    pin(swing.particles, std::vector<int>{0, 8});
    const auto scheme = second_order ? Integrator::tr_bdf2 : Integrator::implicit;
    const EnergyBalance e = simulate(swing, nullptr, options_of(scheme, 1.0 / 60, 0.5)).energy;
    CHECK(e.by_pins == Approx(0).margin(1e-12));
    to_steps[second_order] = e.to_steps();
  }
  CHECK(to_steps[0] > 0);
  CHECK(std::abs(to_steps[1]) < 0.3 * to_steps[0]);
}

TEST_CASE("energy_balance: pins that lift a sheet give energy, and a stop changes no bit") {
  Cloth cloth = swinging_sheet();
  World world;
  MovedPins pins;
  for (std::size_t i = 0; i < cloth.particles.size(); ++i)
    if (!(cloth.particles.inv_mass[i] > 0)) pins.particles.push_back(int(i));
  pins.motion.keyframes = {{0}, {0.5, Vec3(0, 0.3, 0)}};
  world.pins = {pins};
  SimulateOptions o = options_of(Integrator::implicit, 1.0 / 60, 0.5);
  Cloth stopped = cloth;
  const double before = total_energy(cloth, o.gravity);
  const EnergyBalance e = simulate(cloth, world, o).energy;
  const double gained = total_energy(cloth, o.gravity) - before;
  CHECK(e.by_pins > 0);
  CHECK(e.given() - e.lost() == Approx(gained).epsilon(1e-9));

  SimulateState state;
  o.stop_at = 0.2;
  simulate(stopped, world, o, &state);
  o.stop_at.reset();
  const EnergyBalance again = simulate(stopped, world, o, &state).energy;
  CHECK(again.by_pins == e.by_pins);
  CHECK(again.elastic == e.elastic);
  CHECK(again.to_steps() == e.to_steps());
}

TEST_CASE("energy_balance: steps that are not implicit have none") {
  Cloth cloth = swinging_sheet();
  CHECK(simulate(cloth, nullptr, options_of(Integrator::leapfrog, 1e-4, 0.01)).energy.seconds == 0);
}
