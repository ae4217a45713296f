// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "physics/cloth/pins.h"
#include "physics/motion/simulate.h"
#include "tests/physics/motion/hung_sheet.h"

using namespace furrow::physics;
using namespace furrow::tests;

TEST_CASE("simulate: each integrator has its own limit, or none, and counts its work") {
  Cloth cloth = hung_sheet();
  SimulateOptions options;
  options.seconds = 0.05;
  options.spring_damping = 0.02;
  const auto run = [&](Integrator integrator) {
    Cloth copy = cloth;
    options.integrator = integrator;
    return simulate(copy, nullptr, options);
  };
  const double limit = run(Integrator::leapfrog).dt_limit;
  const SimulateReport rk4 = run(Integrator::rk4);
  CHECK(rk4.dt_limit == Approx(std::sqrt(2.0) * limit).epsilon(0.01));
  CHECK(rk4.dt <= 0.9 * rk4.dt_limit);
  CHECK(rk4.force_evaluations == 4 * rk4.steps + 1);
  const SimulateReport implicit = run(Integrator::implicit);
  CHECK(std::isinf(implicit.dt_limit));
  CHECK(implicit.limit_estimates == 0);
  CHECK(implicit.steps == 3);
  CHECK(implicit.iterations >= implicit.steps);
  CHECK(implicit.linear_solves >= implicit.iterations);
  CHECK(implicit.factorisations <= implicit.iterations);
  const SimulateReport xpbd = run(Integrator::xpbd);
  CHECK(std::isinf(xpbd.dt_limit));
  CHECK(xpbd.limit_estimates == 0);
  CHECK(xpbd.steps == 60);
  CHECK(xpbd.iterations == 60 * options.xpbd.iterations);
  CHECK(xpbd.linear_solves == 0);
}

TEST_CASE("simulate: damping that would make RK4 diverge shortens its step") {
  Cloth cloth = hung_sheet();
  SimulateOptions options;
  options.seconds = 0.2;
  options.integrator = Integrator::rk4;
  options.spring_damping = 3;
  const SimulateReport report = simulate(cloth, nullptr, options);
  CHECK(report.outcome == Outcome::finished);
  CHECK(report.kinetic_energy < 1);
  options.dt = 2 * report.dt_limit;
  CHECK_THROWS_WITH(simulate(cloth, nullptr, options), Catch::Contains("above the stability limit"));
}

TEST_CASE("simulate: a run goes on with another integrator, within its limit") {
  Cloth cloth = hung_sheet();
  SimulateOptions options;
  options.seconds = 0.2;
  options.stop_at = 0.1;
  options.integrator = Integrator::implicit;
  SimulateState state;
  CHECK(simulate(cloth, World{}, options, &state).outcome == Outcome::stopped_at);
  options.integrator = Integrator::leapfrog;
  options.stop_at.reset();
  const SimulateReport rest = simulate(cloth, World{}, options, &state);
  CHECK(rest.outcome == Outcome::finished);
  CHECK(rest.dt <= 0.9 * rest.dt_limit);
  CHECK(rest.limit_estimates >= 1);
}
