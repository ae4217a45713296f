// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/motion/stepper.h"

#include <catch2/catch.hpp>

#include "tests/physics/motion/stepper_runs.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

/// What one step does to an oscillator of omega = 1, of which (q, v) and (v, q) are eigenvectors.
struct OneStep {
  double amplitude;  ///< factor a step
  double angle;      ///< turned a step [rad]
};

/// From the steps of (q, v) = (1, 0) and (0, 1) along a spring's axis, where it is linear.
OneStep one_step(Integrator integrator, double z) {
  double a[2][2];
  for (int c = 0; c < 2; ++c) {
    const Cloth start = pendulum(1, 1, 40, {c == 0 ? 41.0 : 40.0, 0, 0}, {c == 1 ? 1.0 : 0.0, 0, 0});
    const Particles end = after(start, {.gravity = Vec3::Zero()}, solved(integrator), z, 1);
    a[0][c] = end.x[1].x() - 40;
    a[1][c] = end.v[1].x();
  }
  const double det = a[0][0] * a[1][1] - a[0][1] * a[1][0], half_trace = (a[0][0] + a[1][1]) / 2;
  return {std::sqrt(det), std::atan2(std::sqrt(det - half_trace * half_trace), half_trace)};
}

OneStep theory(Integrator integrator, double z) {
  if (integrator == furrow::cases::explicit_euler) return {std::sqrt(1 + z * z), std::atan(z)};
  switch (integrator) {
    case Integrator::rk4:
      return {std::sqrt(1 - std::pow(z, 6) / 72 + std::pow(z, 8) / 576),
              std::atan2(z - z * z * z / 6, 1 - z * z / 2 + std::pow(z, 4) / 24)};
    case Integrator::xpbd:
      return {1 / std::sqrt(1 + z * z), std::atan(z)};
    default:
      return {1, 2 * std::asin(z / 2)};
  }
}

struct Order {
  int steps;  ///< the coarsest of three runs; the others have two and four times as many
  double value, margin;
};

/// Of the elastic pendulum over 2 s.
Order pendulum_order(Integrator integrator) {
  switch (integrator) {
    case Integrator::leapfrog:
      return {4000, 2, 0.03};
    case Integrator::rk4:
      return {500, 4, 0.1};
    default:
      return {20000, 1, 0.1};
  }
}

}  // namespace

TEST_CASE("stepper: each integrator turns and scales an oscillator as its theory says") {
  const Integrator integrator = GENERATE(from_range(all_integrators));
  const double z = GENERATE(0.01, 0.1, 0.5, 1.0, 1.9);
  const OneStep is = one_step(integrator, z), should = theory(integrator, z);
  CAPTURE(int(integrator), z);
  CHECK(is.amplitude == Approx(should.amplitude).epsilon(1e-12));
  CHECK(is.angle / z == Approx(should.angle / z).epsilon(1e-10));
}

TEST_CASE("stepper: each integrator has its order on the elastic pendulum", "[release]") {
  const Integrator integrator = GENERATE(from_range(all_integrators));
  const Order order = pendulum_order(integrator);
  const Vec3 exact(0.389103045248, -0.920914325687, 0);
  const Cloth cloth = pendulum(0.1, 50, 1, {1.1, 0.2, 0});
  std::vector<double> errors;
  for (int f = 1; f <= 4; f *= 2) {
    const int steps = f * order.steps;
    errors.push_back((after(cloth, {}, solved(integrator), 2.0 / steps, steps).x[1] - exact).norm());
  }
  CAPTURE(int(integrator), errors);
  CHECK(std::log2(errors[0] / errors[1]) == Approx(order.value).margin(order.margin));
  CHECK(std::log2(errors[1] / errors[2]) == Approx(order.value).margin(order.margin));
}

TEST_CASE("stepper: drag and spring damping keep each integrator's order", "[release]") {
  const Integrator integrator = GENERATE(from_range(all_integrators));
  const Loads loads =
      GENERATE(Loads{.air_drag = 5, .spring_damping = 0}, Loads{.air_drag = 0, .spring_damping = 0.3},
               Loads{.air_drag = 2, .spring_damping = 0.02});
  const Order order = pendulum_order(integrator);
  const int coarsest = order.value == 1 ? 4000 : order.value == 2 ? 800 : 200;
  std::vector<Particles> runs;
  for (int f = 1; f <= 4; f *= 2)
    runs.push_back(after(swinging_sheet(), loads, solved(integrator), 0.1 / (f * coarsest), f * coarsest));
  const double measured = std::log2(distance(runs[0], runs[1]) / distance(runs[1], runs[2]));
  CAPTURE(int(integrator), loads.air_drag, loads.spring_damping);
  CHECK(measured == Approx(order.value).margin(order.value == 2 ? 0.03 : 0.1));
}

TEST_CASE("stepper: XPBD of one sweep has order one, too") {
  const Vec3 exact(0.389103045248, -0.920914325687, 0);
  std::vector<double> errors;
  for (const int steps : {20000, 40000}) {
    const Cloth cloth = pendulum(0.1, 50, 1, {1.1, 0.2, 0});
    const StepperOptions options{Integrator::xpbd, {.iterations = 1}};
    errors.push_back((after(cloth, {}, options, 2.0 / steps, steps).x[1] - exact).norm());
  }
  CHECK(std::log2(errors[0] / errors[1]) == Approx(1).margin(0.1));
}
