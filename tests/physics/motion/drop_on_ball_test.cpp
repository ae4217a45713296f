// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/cases/drop_on_ball.h"

#include <catch2/catch.hpp>

using namespace furrow;
using namespace furrow::cases;
using physics::Integrator;

TEST_CASE(
    "drop_on_ball: a sheet that drapes over a ball never gains energy, never sinks in, and stays on the "
    "axis",
    "[release]") {
  const Drop drop = drop_on_ball({.rings = 6});
  const double limit = step_limit(drop.fall);
  for (const double ratio : {0.25, 0.5}) {
    INFO("dt = " << ratio << " of the limit");
    const DropRun r = run(drop, {Integrator::leapfrog}, ratio * limit);
    CHECK_FALSE(r.end.diverged);
    CHECK(r.end.work.contact.queries > 1000);
    CHECK(r.largest_rise <= 1e-6);
    CHECK(r.deepest <= 1e-3);
    CHECK(r.off_axis <= 1e-4);
  }
}

TEST_CASE("drop_on_ball: contact leaves the stability limit where it is", "[release]") {
  const Drop drop = drop_on_ball({.rings = 5, .stiffness = 1000});
  const double limit = step_limit(drop.fall);
  CHECK(run(drop, {Integrator::leapfrog}, 0.95 * limit).gain < 0.01);
  CHECK(run(drop, {Integrator::leapfrog}, 1.1 * limit).end.diverged);
}
