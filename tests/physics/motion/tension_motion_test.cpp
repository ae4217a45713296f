// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "physics/cloth/elements.h"
#include "physics/cloth/pins.h"
#include "physics/linear/stable_step.h"
#include "physics/motion/leapfrog_step.h"
#include "physics/motion/simulate.h"
#include "tests/physics/cloth/shell_cloths.h"
#include "tests/physics/cloth/tension_cloths.h"
#include "tests/physics/motion/stepper_runs.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

Cloth crumpled_sheet(int columns, int rows, bool all_kinds) {
  Cloth cloth = sheet(columns, rows, 0.02, 0.25);
  const std::vector<Spring> edges = cloth.structural;
  if (!all_kinds) cloth = without_springs(cloth);
  for (const Spring& s : edges) cloth.tension.push_back({s.a, s.b, s.rest_length, 40, 15});
  if (all_kinds) add_membrane(cloth, 300);
  add_hinges(cloth, 1e-5);
  Noise noise(5);
  for (Vec3& x : cloth.particles.x) x += 0.004 * noise.vector();
  return cloth;
}

}  // namespace

TEST_CASE(
    "tension_forces: packed tension exerts the same force as plain one, alone and beside all other kinds") {
  for (const bool all_kinds : {false, true}) {
    const Cloth cloth = crumpled_sheet(31, 23, all_kinds);
    std::vector<Vec3> force(cloth.particles.size(), Vec3::Zero());
    add_forces(cloth, cloth.particles.x, force);
    ThreadPool pool(1);
    Motion motion(cloth, {}, pool);
    const PackedCloth& packed = motion.cloth();
    double largest = 0, difference = 0;
    for (int i = 0; i < packed.particles(); ++i) {
      const Vec3& f = force[std::size_t(packed.particle[std::size_t(i)])];
      const Vec4& p = packed.force[std::size_t(i)];
      largest = std::max(largest, f.norm());
      difference = std::max(difference, (Vec3(p.x, p.y, p.z) - f).norm());
    }
    CHECK(largest > 0.1);
    CHECK(difference < 1e-13 * largest);
    CHECK(motion.work().spring_evaluations ==
          std::int64_t(cloth.structural.size() + cloth.bending.size() + cloth.tension.size()));
    CHECK(pack(cloth).dashpots == int(cloth.tension.size()));  // one an edge, shared with the membrane
  }
}

TEST_CASE("tension_forces: tension moves alike with any number of threads") {
  Cloth cloth = crumpled_sheet(61, 53, false);
  pin(cloth.particles, std::vector<int>{0, 60});
  const auto run = [&](int threads) {
    return after(cloth, {.air_drag = 1, .spring_damping = 0.05}, {}, 5e-5, 40, threads);
  };
  const Particles one = run(1);
  for (const int threads : {2, 3, 7}) {
    const Particles other = run(threads);
    CHECK(one.x == other.x);
    CHECK(one.v == other.v);
  }
}

TEST_CASE("tension_forces: leapfrog keeps energy, momentum and angular momentum of a free sheet of tension") {
  Cloth cloth = crumpled_sheet(7, 6, false);
  for (std::size_t i = 0; i < cloth.particles.size(); ++i)
    cloth.particles.v[i] = Vec3(4, 6, 19).cross(cloth.particles.x[i]) + Vec3(1, -0.5, 0.3);
  struct Sums {
    double energy;
    Vec3 momentum = Vec3::Zero(), angular = Vec3::Zero();
  };
  const auto measure = [](const Cloth& c) {
    Sums sums{potential_energy(c, c.particles.x)};
    for (std::size_t i = 0; i < c.particles.size(); ++i) {
      const Vec3 p = c.particles.mass[i] * c.particles.v[i];
      sums.energy += 0.5 * p.dot(c.particles.v[i]);
      sums.momentum += p, sums.angular += c.particles.x[i].cross(p);
    }
    return sums;
  };
  const double dt = 0.2 * stable_step(cloth).dt_limit;
  const auto errors = [&](double step) {
    ThreadPool pool(1);
    Cloth end = cloth;
    Motion motion(cloth, {.gravity = Vec3::Zero()}, pool);
    const int steps = int(std::round(100 * dt / step));
    for (int i = 0; i < steps; ++i) leapfrog_step(motion, step);
    motion.unpack(end.particles);
    const Sums before = measure(cloth), after = measure(end);
    CHECK((after.momentum - before.momentum).norm() < 1e-12 * before.momentum.norm());
    CHECK((after.angular - before.angular).norm() < 1e-11 * before.angular.norm());
    return std::abs(after.energy - before.energy) / before.energy;
  };
  const double whole = errors(dt), half = errors(dt / 2);
  CAPTURE(whole, half);
  CHECK(whole < 5e-3);
  CHECK(half < 0.3 * whole);  // order two
}

TEST_CASE("tension_forces: XPBD refuses tension instead of leaving it out") {
  Cloth cloth = with_tension(pendulum(0.1, 1, 1, {0, -1, 0}), 50, 0);
  SimulateOptions options;
  options.integrator = Integrator::xpbd;
  CHECK_THROWS_WITH(simulate(cloth, nullptr, options), Catch::Contains("tension"));
}
