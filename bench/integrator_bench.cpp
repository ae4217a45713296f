// SPDX-License-Identifier: GPL-3.0-or-later
// Vertex-steps a second of each integrator on a hung sheet of 2,500 vertices, one thread, and how much faster
// than real time that makes it at its own step.
#include <chrono>
#include <cstdio>

#include "physics/cloth/pins.h"
#include "physics/linear/stable_step.h"
#include "physics/motion/stepper.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;

namespace {

struct Case {
  const char* name;
  StepperOptions options;
  double dt;  // [s]
  int steps;
};

void measure(const Cloth& cloth, const Case& c) {
  ThreadPool pool(1);
  Motion motion(cloth, {.air_drag = 2, .spring_damping = 0.02}, pool);
  const auto stepper = make_stepper(motion, c.options);
  const auto started = std::chrono::steady_clock::now();
  for (int i = 0; i < c.steps; ++i) stepper->step(c.dt);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  const double vertex_steps = double(cloth.particles.size()) * c.steps / seconds;
  std::printf("%-28s dt %.3e s  %10.3e vertex-steps/s  %8.3f ms/step  %8.3f x real time\n", c.name, c.dt,
              vertex_steps, 1e3 * seconds / c.steps, c.dt * c.steps / seconds);
}

}  // namespace

int main() {
  Cloth cloth = furrow::tests::sheet(50, 50, 0.02, 0.2, 2);
  pin(cloth.particles, std::vector<int>{0, 49});
  const double limit = stable_step(cloth).dt_limit;
  std::printf("limit of leapfrog %.3e s\n", limit);
  for (const Case& c : {Case{"leapfrog", {Integrator::leapfrog}, 0.9 * limit, 4000},
                        Case{"RK4", {Integrator::rk4}, 0.9 * rk4_limit / 2 * limit, 2000},
                        Case{"implicit", {Integrator::implicit}, 1.0 / 60, 40},
                        Case{"XPBD, 10 sweeps", {Integrator::xpbd, {10}}, 1.0 / 1200, 1000},
                        Case{"XPBD, 1 sweep", {Integrator::xpbd, {1}}, 1.0 / 1200, 4000}})
    measure(cloth, c);
}
