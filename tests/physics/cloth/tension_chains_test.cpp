// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/physics/cloth/tension_chains.h"

#include <catch2/catch.hpp>

#include "physics/motion/simulate.h"
#include "physics/rest/static_equilibrium.h"

using namespace furrow::physics;
using namespace furrow::tests;

TEST_CASE("a vertical chain of tension hangs by e = sqrt(T / c) from its rest, where nothing is stiff") {
  for (const Hanging& chain : hanging_chains) {
    CAPTURE(chain.springs, chain.c);
    Cloth cloth = hanging_at_rest(chain);
    StaticOptions options;
    options.tolerance = 1e-10;
    const StaticReport report = find_static_equilibrium(cloth, options);
    CHECK(report.converged);
    CHECK(report.stable);
    const double worst = largest_strain_error(cloth, chain);
    CAPTURE(worst);
    CHECK(worst < 1e-9);
    const double largest = largest_strain(cloth) * cloth.tension[0].rest_length;
    CHECK(largest == Approx(chain.largest_extension).epsilon(1e-9));
    CHECK(lowest(cloth) == Approx(chain.hanging_length).epsilon(1e-9));
  }
}

TEST_CASE("level chains of tension have the exact sags, from a flat start, a deep one, with pushing or not") {
  for (const Level& chain : level_chains) {
    for (const double depth : {0.0, 0.7}) {
      for (const double compress : {0.0, 0.3}) {
        CAPTURE(chain.span, chain.length, depth, compress);
        Cloth cloth = level_chain(chain, depth, compress);
        if (depth == 0) cloth.particles.x[std::size_t(chain.springs / 3)].y() -= 1e-4;  // off the symmetry
        StaticOptions options;
        options.tolerance = 1e-8;
        CHECK(find_static_equilibrium(cloth, options).converged);
        CHECK(lowest(cloth) == Approx(chain.sag).margin(1e-8));
        CHECK(largest_strain(cloth) == Approx(chain.largest_strain).epsilon(1e-6));
      }
    }
  }
}

TEST_CASE("leapfrog, RK4 and backward Euler bring a chain of tension to the same rest") {
  const Level& chain = level_chains[2];
  Cloth exact = level_chain(chain, 0.4, 0.2);
  StaticOptions statics;
  statics.tolerance = 1e-10;
  CHECK(find_static_equilibrium(exact, statics).converged);
  for (const Integrator integrator : {Integrator::leapfrog, Integrator::rk4, Integrator::backward_euler}) {
    Cloth cloth = level_chain(chain, 0.4, 0.2);
    SimulateOptions options;
    options.integrator = integrator;
    options.seconds = 6;
    options.air_drag = 8;
    options.spring_damping = 0.2;
    const SimulateReport report = simulate(cloth, nullptr, options);
    CHECK(report.outcome == Outcome::finished);
    CHECK(report.spring_evaluations == report.force_evaluations * std::int64_t(cloth.tension.size()));
    double worst = 0;
    for (std::size_t i = 0; i < cloth.particles.size(); ++i)
      worst = std::max(worst, (cloth.particles.x[i] - exact.particles.x[i]).norm());
    CAPTURE(int(integrator), worst);
    CHECK(worst < 1e-5);
  }
}
