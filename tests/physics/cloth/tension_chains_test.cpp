// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/physics/cloth/tension_chains.h"

#include <catch2/catch.hpp>

#include "physics/motion/simulate.h"
#include "tests/physics/rest/settled.h"

using namespace furrow::physics;
using namespace furrow::tests;

TEST_CASE("tension_forces: leapfrog, RK4 and implicit steps bring a chain of tension to the same rest") {
  const Level& chain = level_chains[2];
  Cloth exact = level_chain(chain, 0.4, 0.2);
  CHECK(find_rest(exact, down_to(1e-10)).converged);
  for (const Integrator integrator : {Integrator::leapfrog, Integrator::rk4, Integrator::implicit}) {
    Cloth cloth = level_chain(chain, 0.4, 0.2);
    SimulateOptions options;
    options.integrator = integrator;
    options.seconds = 6;
    options.air_drag = 8;
    options.spring_damping = 0.2;
    const SimulateReport report = simulate(cloth, nullptr, options);
    CHECK(report.outcome == Outcome::finished);
    if (!solves_contact(integrator))  // which count iterations
      CHECK(report.spring_evaluations == report.force_evaluations * std::int64_t(cloth.tension.size()));
    double worst = 0;
    for (std::size_t i = 0; i < cloth.particles.size(); ++i)
      worst = std::max(worst, (cloth.particles.x[i] - exact.particles.x[i]).norm());
    CAPTURE(int(integrator), worst);
    CHECK(worst < 1e-5);
  }
}
