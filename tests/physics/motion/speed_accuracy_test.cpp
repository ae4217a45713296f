// SPDX-License-Identifier: GPL-3.0-or-later
// What docs/accuracy.md says about integrators, without a clock.
#include <catch2/catch.hpp>

#include "tests/cases/baselines.h"
#include "tests/cases/swing.h"

using namespace furrow::physics;
using namespace furrow::cases;

namespace {

struct Result {
  double error;
  std::int64_t forces;
  bool diverged;
};

/// A swing, its limit and its exact end.
struct Bench {
  Swing swing;
  double limit;
  std::vector<Vec3> exact;
  explicit Bench(const SheetOptions& options)
      : swing(sheet_swing(options)),
        limit(step_limit(swing)),
        exact(run(swing, {Integrator::rk4}, 0.1 * limit).x) {}

  Result operator()(Integrator integrator, double dt_over_limit) const {
    const SwingRun end = run(swing, {integrator, {.iterations = 1}}, dt_over_limit * limit);
    return {relative_error(swing, end.x, exact), end.work.force_evaluations, end.diverged};
  }
};

}  // namespace

TEST_CASE(
    "speed and accuracy: leapfrog is better than what costs the same forces, RK4 better once they are many",
    "[release]") {
  const Bench bench({.columns = 6, .jitter = 0.2, .seconds = 0.2});
  const Result leapfrog = bench(Integrator::leapfrog, 0.5), finer = bench(Integrator::leapfrog, 0.25);
  const Result semi = bench(semi_implicit, 0.5), finer_semi = bench(semi_implicit, 0.25);
  const Result rk4 = bench(Integrator::rk4, 1), euler = bench(explicit_euler, 0.01);
  CHECK(leapfrog.forces == semi.forces);
  CHECK(leapfrog.error < 0.05 * semi.error);
  CHECK(leapfrog.error / finer.error == Approx(4).epsilon(0.1));
  CHECK(semi.error / finer_semi.error == Approx(2).epsilon(0.1));
  CHECK(std::abs(rk4.forces - finer.forces) <= 4);
  CHECK(rk4.error < 0.2 * finer.error);
  CHECK(euler.forces > 40 * leapfrog.forces);
  CHECK(euler.error > leapfrog.error);
  for (const Integrator stable : {Integrator::implicit, Integrator::xpbd}) {
    CHECK(bench(stable, 4).error > 100 * leapfrog.error);
    CHECK(bench(stable, 4).error < 0.1);
    const Result coarse = bench(stable, 100);
    CHECK_FALSE(coarse.diverged);
    CHECK(coarse.error > 0.1);
  }
}

TEST_CASE("stability map: 2/omega_max parts stable from diverged for each law, mesh and stiffness",
          "[release]") {
  for (const MembraneLaw law :
       {MembraneLaw::paper, MembraneLaw::uniform, MembraneLaw::inverse, MembraneLaw::van_gelder}) {
    for (const double jitter : {0.0, 0.3}) {
      for (const double k : {100.0, 1e4}) {
        const Bench bench({.columns = 6, .stiffness = k, .jitter = jitter, .law = law, .spring_damping = 0});
        CAPTURE(int(law), jitter, k);
        CHECK(bench(Integrator::leapfrog, 0.98).error < 0.01);
        CHECK(bench(Integrator::leapfrog, 1.03).diverged);
        CHECK(bench(semi_implicit, 1.03).diverged);
        CHECK(bench(Integrator::rk4, 0.98 * rk4_limit / 2).error < 0.01);
        CHECK(bench(Integrator::rk4, 1.2 * rk4_limit / 2).error > 0.01);
      }
    }
  }
}
