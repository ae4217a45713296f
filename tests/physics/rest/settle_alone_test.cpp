// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <limits>

#include "physics/contact/residual_force.h"
#include "physics/rest/settle.h"
#include "tests/physics/cloth/strips.h"
#include "tests/physics/rest/hanging_chains.h"
#include "tests/physics/rest/settled.h"

using namespace furrow::physics;
using namespace furrow::tests;

TEST_CASE("settle: a mass on a spring hangs by its elongation, from any start above or below") {
  for (const Vec3& start : {Vec3(0.1, -0.9, 0.2), Vec3(0.3, 0.7, -0.2), Vec3(2, -0.1, 0)}) {
    Cloth cloth = pendulum(0.1, 50, 1, start, {1, 2, 3});
    const SettleOptions options = down_to(1e-12);
    const Settled report = find_rest(cloth, options);
    CHECK((cloth.particles.x[1] - Vec3(0, -1 - 0.1 * 9.81 / 50, 0)).norm() < 1e-12);
    CHECK(cloth.particles.x[0] == Vec3::Zero());
    CHECK(cloth.particles.v[1] == Vec3::Zero());
    CHECK(report.converged);
    CHECK(report.stable);
    CHECK(report.residual <= 1e-12);
    CHECK(report.factorisations >= report.iterations);
    CHECK(report.residual == Approx(residual_force(cloth, options.gravity, nullptr, 0, 0.01)).margin(1e-15));
  }
}

TEST_CASE("settle: a spring that stands on its head stays there and is not stable") {
  Cloth cloth = pendulum(0.1, 50, 1, {0, 1.1, 0});
  const Settled report = find_rest(cloth, down_to(1e-6));
  CHECK(cloth.particles.x[1].y() == Approx(1 - 0.1 * 9.81 / 50));
  CHECK(report.converged);
  CHECK_FALSE(report.stable);
}

TEST_CASE("settle: even chains approach the elastic catenary with order two") {
  std::vector<double> errors;
  for (const int n : {16, 32, 64}) {
    Cloth chain = hanging_chain(n, 0);
    CHECK(find_rest(chain, down_to(1e-6)).converged);
    errors.push_back(-chain.particles.x[n / 2].y() - 0.505865838778);  // Irvine's elastic catenary
  }
  CHECK(errors.back() == Approx(7.948e-5).epsilon(0.01));
  CHECK(std::log2(errors[0] / errors[1]) == Approx(2).margin(0.03));
  CHECK(std::log2(errors[1] / errors[2]) == Approx(2).margin(0.03));
}

TEST_CASE("settle: a load that grows in steps leads to the same state, and the same input to the same bits") {
  StripOptions small;
  small.rows = 8;
  small.columns = 2;
  const Strip strip = equilateral_strip(small);
  const Vec3 gravity(0, 0, -gravity_for(10, small.density, small.length, small.rigidity));
  Cloth a = strip.cloth, b = strip.cloth, c = strip.cloth;
  find_rest(a, down_to(1e-6, gravity));
  find_rest(b, down_to(1e-6, gravity));
  CHECK(a.particles.x == b.particles.x);
  for (int k = 1; k <= 4; ++k) CHECK(find_rest(c, down_to(1e-6, k / 4.0 * gravity)).converged);
  for (std::size_t i = 0; i < a.particles.size(); ++i)
    CHECK((a.particles.x[i] - c.particles.x[i]).norm() < 1e-7);
  CHECK(find_rest(c, down_to(1e-6, gravity)).iterations == 0);  // at rest already
}

TEST_CASE("settle: iterations end where they are told to, and round-off does no harm") {
  StripOptions small;
  small.rows = 8;
  small.columns = 2;
  Strip strip = equilateral_strip(small);
  SettleOptions options = down_to(1e-6, {0, 0, -1});
  options.max_iterations = 3;
  Settled report = find_rest(strip.cloth, options);
  CHECK(report.iterations == 3);
  CHECK_FALSE(report.converged);
  options.max_iterations = 200;
  options.tolerance = 1e-300;
  report = find_rest(strip.cloth, options);
  CHECK(report.stuck);
  CHECK(report.iterations > 30);
  CHECK(report.iterations < 200);  // as thirty steps led nowhere
  CHECK(report.residual < 1e-5);
  CHECK(report.stable);
  CHECK_FALSE(report.converged);
}

TEST_CASE("settle: what cannot be is refused and nothing moves") {
  const Cloth good = pendulum(0.1, 50, 1, {0.1, -0.9, 0.2});
  const auto refuses = [&](const Cloth& cloth, const SettleOptions& options, const std::string& word) {
    Cloth copy = cloth;
    CHECK_THROWS_WITH(settle(copy, nullptr, options), Catch::Contains(word));
    CHECK(copy.particles.v == cloth.particles.v);
  };
  SettleOptions o;
  o.tolerance = 0;
  refuses(good, o, "tolerance = 0");
  o = {};
  o.max_iterations = -1;
  refuses(good, o, "max_iterations = -1");
  o = {};
  o.gravity.x() = std::numeric_limits<double>::quiet_NaN();
  refuses(good, o, "gravity");
  Cloth bad = good;
  bad.particles.mass[1] = 0;
  refuses(bad, {}, "mass of free particle 1 = 0");
  bad = good;
  bad.particles.v.pop_back();
  refuses(bad, {}, "velocities");
  bad = good;
  bad.particles.x[1].y() = std::numeric_limits<double>::infinity();
  refuses(bad, {}, "position of particle 1");
  bad = good;
  bad.structural[0].b = 7;
  refuses(bad, {}, "7");
}
