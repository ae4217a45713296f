// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "tests/physics/cloth/shell_cloths.h"
#include "tests/physics/motion/stepper_runs.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

/// A small sheet of membrane and hinges with two pins, far from rest.
Cloth swinging_shell(double young = 20, double rigidity = 1e-3) {
  Cloth cloth = sheet(5, 4, 0.1, 0.2, 3, 20, 2);
  add_membrane(cloth, young);
  add_hinges(cloth, rigidity);
  cloth = without_springs(cloth);
  Noise noise(8);
  for (Vec3& x : cloth.particles.x) x += 0.01 * noise.vector();
  for (Vec3& v : cloth.particles.v) v = 0.5 * noise.vector();
  pin(cloth.particles, std::vector<int>{0, 4});
  return cloth;
}

}  // namespace

TEST_CASE("stepper: each integrator keeps its order on a shell, with damping, too", "[release]") {
  struct Case {
    Integrator integrator;
    int steps;  // the coarsest of three runs
    double order;
  };
  const Case c = GENERATE(Case{Integrator::rk4, 200, 4}, Case{Integrator::implicit, 6000, 1},
                          Case{Integrator::tr_bdf2, 100, 2});
  const Loads loads{.air_drag = 1, .spring_damping = 0.1};
  const StepperOptions options{c.integrator, {}, {.tolerance = 1e-4, .few = 12}};
  std::vector<Particles> runs;
  for (const int f : {1, 2, 4})
    runs.push_back(after(swinging_shell(), loads, options, 0.1 / (f * c.steps), f * c.steps));
  CHECK(distance(runs[0], swinging_shell().particles) > 0.05);
  const double order = std::log2(distance(runs[0], runs[1]) / distance(runs[1], runs[2]));
  CAPTURE(int(c.integrator));
  CHECK(order == Approx(c.order).margin(0.1));
}

TEST_CASE("stepper: implicit steps keep a shell's momentum and are stable at a hundred times the limit") {
  Cloth cloth = swinging_shell(1000, 1e-4);
  Particles& p = cloth.particles;
  for (std::size_t i = 0; i < p.size(); ++i) p.inv_mass[i] = 1 / p.mass[i];
  const double dt = 0.1;  // 2 / omega is about 1 ms
  const StepperOptions closely{Integrator::implicit, {}, {.tolerance = 1e-5, .few = 12}};
  const Particles end = after(cloth, {.gravity = Vec3::Zero()}, closely, dt, 200);
  Vec3 change = Vec3::Zero();
  double scale = 0, fastest = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    change += p.mass[i] * (end.v[i] - p.v[i]);
    scale += p.mass[i] * p.v[i].norm();
    fastest = std::max(fastest, end.v[i].norm());
  }
  CHECK(fastest < 2);
  CAPTURE(change.norm() / scale);
  CHECK(change.norm() < 1e-6 * scale);
}

TEST_CASE("stepper: XPBD refuses a shell") {
  ThreadPool pool(1);
  Motion motion(swinging_shell(), {}, pool);
  CHECK_THROWS_WITH(make_stepper(motion, {Integrator::xpbd}), Catch::Contains("springs only"));
}
