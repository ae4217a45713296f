// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "physics/linear/stable_step.h"
#include "tests/physics/motion/stepper_runs.h"

using namespace furrow::physics;
using namespace furrow::tests;

TEST_CASE("stepper: the limits of stability are where theory has them") {
  struct Limit {
    Integrator integrator;
    double z;
  };
  const Limit limit = GENERATE(Limit{Integrator::leapfrog, 2}, Limit{furrow::cases::semi_implicit, 2},
                               Limit{Integrator::rk4, rk4_limit});
  const auto amplitude = [&](double z) {
    const Cloth start = pendulum(1, 1, 1e6, {1e6 + 1, 0, 0});
    const Particles end = after(start, {.gravity = Vec3::Zero()}, {limit.integrator}, z, 600);
    return std::hypot(end.x[1].x() - 1e6, end.v[1].x());
  };
  CAPTURE(int(limit.integrator));
  CHECK(amplitude(0.995 * limit.z) < 30);
  CHECK(!(amplitude(1.005 * limit.z) < 1000));
}

TEST_CASE("stepper: damping shortens the limit neither of leapfrog nor of semi-implicit Euler") {
  const Integrator integrator = GENERATE(Integrator::leapfrog, furrow::cases::semi_implicit);
  const double damping = GENERATE(0.02, 0.3, 3.0);
  const Cloth start = pendulum(1, 1, 1e6, {1e6 + 1, 0, 0});
  const Loads loads{.gravity = Vec3::Zero(), .air_drag = 0.1, .spring_damping = damping};
  const Particles end = after(start, loads, {integrator}, 0.995 * 2, 3000);
  CAPTURE(int(integrator), damping);
  CHECK(std::hypot(end.x[1].x() - 1e6, end.v[1].x()) < 1);
}

TEST_CASE("stepper: what solves stays stable at a hundred times the limit", "[long]") {
  const Integrator integrator = GENERATE(Integrator::xpbd, Integrator::implicit, Integrator::tr_bdf2);
  const bool closely = GENERATE(false, true);
  Cloth cloth = sheet(12, 10, 0.05, 0.2, 2);
  pin(cloth.particles, std::vector<int>{0, 11});
  const double dt = 100 * stable_step(cloth).dt_limit;
  const StepperOptions options = closely
                                     ? StepperOptions{integrator, {.iterations = 100}, {.tolerance = 1e-6}}
                                     : StepperOptions{integrator};
  ThreadPool pool(1);
  Motion motion(cloth, {}, pool);
  const auto stepper = make_stepper(motion, options);
  double fastest = 0;
  for (int i = 0; i < 300; ++i) {
    stepper->step(dt);
    for (const Vec4& v : motion.cloth().v) fastest = std::max(fastest, std::hypot(v.x, v.y, v.z));
  }
  CAPTURE(int(integrator), closely, dt, fastest);
  CHECK(fastest < 20);
  Particles end = cloth.particles;
  motion.unpack(end);
  double fast = 0, low = 0;
  for (std::size_t i = 0; i < end.size(); ++i)
    fast = std::max(fast, end.v[i].norm()), low = std::min(low, end.x[i].y());
  CHECK(fast < 0.5);
  CHECK(low > -1);
}

TEST_CASE("stepper: each integrator keeps the momentum of a free cloth, with spring damping, too") {
  const Integrator integrator = GENERATE(from_range(all_integrators));
  const double damping = GENERATE(0.0, 0.1);
  Cloth cloth = swinging_sheet();
  Particles& p = cloth.particles;
  for (std::size_t i = 0; i < p.size(); ++i) p.inv_mass[i] = 1 / p.mass[i];
  const int steps = integrator == furrow::cases::explicit_euler ? 200 : 2000;
  const Particles end =
      after(cloth, {.gravity = Vec3::Zero(), .spring_damping = damping}, {integrator}, 5e-4, steps);
  Vec3 change = Vec3::Zero();
  double scale = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    change += p.mass[i] * (end.v[i] - p.v[i]);
    scale += p.mass[i] * p.v[i].norm();
  }
  CAPTURE(int(integrator), damping);
  CHECK(distance(end, p) > 0.01);
  CHECK(change.norm() < 1e-12 * scale);
}

TEST_CASE("stepper: XPBD with many sweeps is an implicit step but for its turning directions") {
  const Cloth cloth = swinging_sheet();
  const Particles implicit = after(cloth, {}, solved(Integrator::implicit), 1e-3, 100);
  const Particles sweeps = after(cloth, {}, {Integrator::xpbd, {.iterations = 5000}}, 1e-3, 100);
  const Particles exact = after(cloth, {}, {Integrator::leapfrog}, 1e-5, 10000);
  CHECK(distance(implicit, exact) > 3e-3);
  CHECK(distance(implicit, sweeps) < 0.1 * distance(implicit, exact));
}

TEST_CASE("stepper: each integrator gives the same bits for any number of threads") {
  const Integrator integrator = GENERATE(from_range(all_integrators));
  Cloth cloth = sheet(60, 50, 0.02, 0.2, 2);  // two blocks
  Noise noise(4);
  for (Vec3& v : cloth.particles.v) v = 0.1 * noise.vector();
  pin(cloth.particles, std::vector<int>{0, 59});
  Wind wind;
  wind.velocity = Vec3(1, 0, 2);
  const Loads loads{.air_drag = 2, .spring_damping = 0.05};
  const Surroundings around{.wind = &wind};
  const Particles one = after(cloth, loads, {integrator}, 1e-5, 5, 1, around),
                  two = after(cloth, loads, {integrator}, 1e-5, 5, 2, around);
  CHECK(one.x == two.x);
  CHECK(one.v == two.v);
}

TEST_CASE("stepper: wind and drag carry each integrator's cloth to the air's speed") {
  const Integrator integrator = GENERATE(from_range(all_integrators));
  const Cloth cloth = sheet(4, 4, 0.1, 0, 1, 0.01, 0.01);  // so soft that explicit Euler holds, too
  Wind wind;
  wind.velocity = Vec3(1, 0, 0.5);
  const Particles end =
      after(cloth, {.gravity = Vec3::Zero(), .air_drag = 4}, {integrator}, 1e-4, 5000, 1, {.wind = &wind});
  for (const Vec3& v : end.v) CHECK((v - (1 - std::exp(-2.0)) * wind.velocity).norm() < 1e-3);
}

TEST_CASE("stepper: steppers refuse what is out of range") {
  ThreadPool pool(1);
  Motion motion(sheet(3, 3, 0.1), {}, pool);
  for (const Integrator integrator : all_integrators)
    CHECK_THROWS_WITH(furrow::cases::make_stepper(motion, {integrator})->step(0), Catch::Contains("dt = 0"));
  CHECK_THROWS_WITH(make_stepper(motion, {Integrator::xpbd, {.iterations = 0}}),
                    Catch::Contains("iterations = 0"));
  CHECK_THROWS_WITH(make_stepper(motion, {.integrator = Integrator::implicit, .implicit = {.tolerance = 0}}),
                    Catch::Contains("tolerance = 0"));
}
