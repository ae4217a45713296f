// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "physics/motion/simulate.h"
#include "tests/physics/rest/hanging_chains.h"

using namespace furrow::physics;
using namespace furrow::tests;

TEST_CASE("simulate: a hanging chain of uneven springs comes to rest at the exact solution") {
  Cloth chain = hanging_chain();
  const std::vector<Eigen::Vector2d> exact = exact_chain(chain);
  SimulateOptions options;
  options.seconds = 8;
  options.air_drag = 6;
  options.spring_damping = 0.2;
  const SimulateReport report = simulate(chain, nullptr, options);
  CHECK(report.outcome == Outcome::finished);
  double worst = 0, lowest = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const Vec3& x = chain.particles.x[i];
    worst = std::max(worst, (x - Vec3(exact[i].x(), exact[i].y(), 0)).norm());
    lowest = std::min(lowest, x.y());
  }
  CHECK(lowest < -0.45);
  CHECK(worst < 1e-5);
  CHECK(report.residual_force < 1e-4);
}
