// SPDX-License-Identifier: GPL-3.0-or-later
// Cloths of membrane and hinges alone in motion: orders, energy, limits of the step, counters.
#include <catch2/catch.hpp>

#include "physics/cloth/elements.h"
#include "physics/cloth/pins.h"
#include "physics/contact/residual_force.h"
#include "physics/linear/stable_step.h"
#include "physics/motion/leapfrog_step.h"
#include "physics/motion/simulate.h"
#include "tests/physics/cloth/shell_cloths.h"
#include "tests/physics/motion/stepper_runs.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

Cloth shell(int columns, int rows, double edge, double jitter, double young, double rigidity) {
  Cloth cloth = without_springs(sheet(columns, rows, edge, jitter, 3));
  if (young > 0) add_membrane(cloth, young);
  if (rigidity > 0) add_hinges(cloth, rigidity);
  return cloth;
}

Cloth swinging(HingeLaw law) {
  Cloth cloth = shell(5, 4, 0.1, 0.2, 20, 0.02);
  cloth.hinge_law = law;
  Noise noise(8);
  for (Vec3& x : cloth.particles.x) x += 0.01 * noise.vector();
  for (Vec3& v : cloth.particles.v) v = 0.5 * noise.vector();
  pin(cloth.particles, std::vector<int>{0, 4});
  return cloth;
}

double energy_of(const Cloth& cloth) {
  return kinetic_energy(cloth.particles) + potential_energy(cloth, cloth.particles.x);
}

/// Stays near rest at 0.98 of the limit, leaves it at 1.05.
void check_limit(Cloth cloth, double dt_limit) {
  Noise noise(12);
  const Particles rest = cloth.particles;
  for (Vec3& x : cloth.particles.x) x += 1e-10 * noise.vector();
  const double start = distance(cloth.particles, rest);
  const Loads weightless{.gravity = Vec3::Zero()};
  CHECK(distance(after(cloth, weightless, 0.98 * dt_limit, 3000), rest) < 300 * start);
  CHECK(!(distance(after(cloth, weightless, 1.05 * dt_limit, 60), rest) < 1e4 * start));
}

}  // namespace

TEST_CASE("simulate: leapfrog has order two with membrane and hinges, with damping, too") {
  const HingeLaw law = GENERATE(HingeLaw::linear, HingeLaw::cosine);
  const Loads loads = GENERATE(Loads{}, Loads{.air_drag = 2, .spring_damping = 0.3});
  std::vector<Particles> runs;
  for (const int steps : {800, 1600, 3200, 6400})
    runs.push_back(after(swinging(law), loads, 0.1 / steps, steps));
  for (int i = 0; i < 2; ++i) {
    const double order = std::log2(distance(runs[i], runs[i + 1]) / distance(runs[i + 1], runs[i + 2]));
    CAPTURE(i, order);
    CHECK(order == Approx(2).margin(0.03));
  }
}

TEST_CASE("simulate: a free fluttering sheet keeps its energy, and damping takes it away") {
  Cloth cloth = shell(8, 8, 0.05, 0.2, 50, 1e-3);
  Noise noise(4);
  for (Vec3& v : cloth.particles.v) v = 0.3 * noise.vector();
  const double start = energy_of(cloth), limit = stable_step(cloth).dt_limit;
  const auto drift = [&](double share, double damping) {
    Cloth moved = cloth;
    const int steps = int(1 / (share * limit));
    moved.particles =
        after(cloth, {.gravity = Vec3::Zero(), .spring_damping = damping}, share * limit, steps);
    CHECK(distance(moved.particles, cloth.particles) > 0.1);
    return (energy_of(moved) - start) / start;
  };
  const double coarse = std::abs(drift(0.25, 0));
  CAPTURE(coarse);
  CHECK(coarse < 0.01);
  CHECK(drift(0.25, 0.1) < -0.05);
}

TEST_CASE("simulate: the limit of sheets of membrane or hinges is that where leapfrog diverges") {
  const double jitter = GENERATE(0.0, 0.3);
  for (const auto& [young, rigidity] : {std::pair{200.0, 1e-6}, {200.0, 0.0}, {1.0, 1.0}}) {
    CAPTURE(jitter, young, rigidity);
    const Cloth cloth = shell(8, 8, 0.1, jitter, young, rigidity);
    check_limit(cloth, stable_step(cloth, {.tolerance = 1e-6}).dt_limit);
  }
}

TEST_CASE("simulate: the limit of a plate of equilateral triangles has the known constant") {
  // dt = C h^2 sqrt(rho_A / B). Inside, theta = (w0 + w1 - w2 - w3) / (h sqrt(3)/2), and the wave of three
  // colours (cos 2 pi/3 between neighbours) is the fastest: omega^2 = 48 B / (rho_A h^4), C = 2 / sqrt(48).
  // The border of a free sheet is lighter, but softer still: its waves are slower.
  const double h = 0.05, rigidity = 1e-3, density = 0.15;
  Cloth cloth = shell(30, 30, h, 0, 0, rigidity);
  const auto constant = [&] {
    return stable_step(cloth, {.tolerance = 1e-3}).dt_limit / (h * h * std::sqrt(density / rigidity));
  };
  const double free = constant();
  for (std::size_t i = 0; i < cloth.particles.size(); ++i) {
    const int c = int(i) % 30, r = int(i) / 30;
    if (c == 0 || c == 29 || r == 0 || r == 29) cloth.particles.inv_mass[i] = 0;
  }
  const double inside = constant();
  CAPTURE(free, inside);
  CHECK(inside == Approx(2 / std::sqrt(48)).epsilon(0.01));
  CHECK(free == Approx(2 / std::sqrt(48)).epsilon(0.01));
}

TEST_CASE("simulate: a hinge that is bent and a cosine hinge count in the limit") {
  Cloth cloth = shell(6, 6, 0.1, 0.2, 20, 1);
  const double flat = stable_step(cloth).dt_limit;
  cloth.hinge_law = HingeLaw::cosine;
  CHECK(stable_step(cloth).dt_limit == Approx(flat).epsilon(1e-12));  // E'' at its largest
  Noise noise(3);
  for (Hinge& h : cloth.hinges) h.rest_angle = 2.5 * noise();
  CHECK(stable_step(cloth).dt_limit < flat);
}

TEST_CASE("simulate: it counts what it evaluates, through a stop, too") {
  Cloth cloth = shell(5, 5, 0.1, 0.2, 50, 1e-4);
  pin(cloth.particles, std::vector<int>{0, 4});
  SimulateOptions options;
  options.seconds = 0.2;
  Cloth whole = cloth, parts = cloth;
  const SimulateReport report = simulate(whole, World{}, options);
  SimulateState state;
  options.stop_at = 0.07;
  simulate(parts, World{}, options, &state);
  options.stop_at.reset();
  const SimulateReport resumed = simulate(parts, World{}, options, &state);
  CHECK(whole.particles.x == parts.particles.x);
  CHECK(whole.particles.v == parts.particles.v);
  for (const SimulateReport& r : {report, resumed}) {
    CHECK(r.outcome == Outcome::finished);
    CHECK(r.force_evaluations == r.steps + 1);
    CHECK(r.spring_evaluations == 0);
    CHECK(r.triangle_evaluations == r.force_evaluations * std::int64_t(cloth.membrane.size()));
    CHECK(r.hinge_evaluations == r.force_evaluations * std::int64_t(cloth.hinges.size()));
    CHECK(r.strain.max > 0);
  }
  Cloth springs = sheet(5, 5, 0.1);
  const SimulateReport other = simulate(springs, nullptr, options);
  CHECK(other.triangle_evaluations + other.hinge_evaluations == 0);
  CHECK(other.spring_evaluations ==
        other.force_evaluations * std::int64_t(springs.structural.size() + springs.bending.size()));
}

TEST_CASE("simulate: forces of membrane and hinges count in the residual force and in a jump") {
  Cloth cloth = shell(4, 4, 0.1, 0.2, 50, 1e-4);
  CHECK(residual_force(cloth, Vec3::Zero(), nullptr, 0.3, 0.003) < 1e-9);
  Cloth strained = cloth;
  for (Vec3& x : strained.particles.x) x *= 1.01;
  CHECK(residual_force(strained, Vec3::Zero(), nullptr, 0.3, 0.003) > 1);
  const std::vector<Vec3> jump = force_jump(cloth, strained);
  std::vector<Vec3> force(jump.size(), Vec3::Zero());
  add_forces(strained, strained.particles.x, force);
  for (std::size_t i = 0; i < jump.size(); ++i) CHECK((jump[i] - force[i]).norm() < 1e-12);
}
