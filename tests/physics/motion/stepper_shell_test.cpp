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

TEST_CASE("stepper: RK4 and backward Euler keep their orders on a shell, with damping, too", "[release]") {
  const Integrator integrator = GENERATE(Integrator::rk4, Integrator::backward_euler);
  const bool rk4 = integrator == Integrator::rk4;
  const Loads loads{.air_drag = 1, .spring_damping = 0.1};
  std::vector<Particles> runs;
  for (const int f : {1, 2, 4}) {
    const int steps = f * (rk4 ? 200 : 3000);
    runs.push_back(after(swinging_shell(), loads, solved(integrator), 0.1 / steps, steps));
  }
  CHECK(distance(runs[0], swinging_shell().particles) > 0.05);
  const double order = std::log2(distance(runs[0], runs[1]) / distance(runs[1], runs[2]));
  CHECK(order == Approx(rk4 ? 4 : 1).margin(0.1));
}

TEST_CASE("stepper: backward Euler keeps a shell's momentum and is stable at a hundred times the limit") {
  Cloth cloth = swinging_shell(1000, 1e-4);
  Particles& p = cloth.particles;
  for (std::size_t i = 0; i < p.size(); ++i) p.inv_mass[i] = 1 / p.mass[i];
  const double dt = 0.1;  // 2 / omega is about 1 ms
  const Particles end =
      after(cloth, {.gravity = Vec3::Zero()}, {Integrator::backward_euler, {}, {}}, dt, 200);
  Vec3 change = Vec3::Zero();
  double scale = 0, fastest = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    change += p.mass[i] * (end.v[i] - p.v[i]);
    scale += p.mass[i] * p.v[i].norm();
    fastest = std::max(fastest, end.v[i].norm());
  }
  CHECK(fastest < 2);
  CHECK(change.norm() < 1e-9 * scale);  // of systems whose stiffness outweighs the masses ten thousand times
}

TEST_CASE("stepper: XPBD refuses a shell") {
  ThreadPool pool(1);
  Motion motion(swinging_shell(), {}, pool);
  CHECK_THROWS_WITH(make_stepper(motion, {Integrator::xpbd, {}, {}}), Catch::Contains("springs only"));
}
