// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/linear/stable_step.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "physics/cloth/pins.h"
#include "physics/cloth/spring_forces.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

/// 2 / omega_max by a dense eigenvalue solve.
double exact_limit(const Cloth& cloth, Stiffness stiffness) {
  const Particles& p = cloth.particles;
  const Eigen::Index n = Eigen::Index(3 * p.size());
  Eigen::MatrixXd matrix(n, n);
  for (Eigen::Index c = 0; c < n; ++c) {
    std::vector<Vec3> u(p.size(), Vec3::Zero()), ku = u;
    u[c / 3][c % 3] = std::sqrt(p.inv_mass[c / 3]);
    add_spring_stiffness_product(p.x, cloth.structural, u, stiffness, ku);
    add_spring_stiffness_product(p.x, cloth.bending, u, stiffness, ku);
    for (Eigen::Index r = 0; r < n; ++r) matrix(r, c) = std::sqrt(p.inv_mass[r / 3]) * ku[r / 3][r % 3];
  }
  return 2 / std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, false).eigenvalues()[n - 1]);
}

}  // namespace

TEST_CASE("stable_step: the limit of a chain between walls is that of its highest mode", "[long]") {
  // Along x with springs at rest only longitudinal modes have stiffness; the top of their spectrum is
  // crowded, so the largest eigenvalue comes slowly and its residual counts.
  const int n = GENERATE(20, 200, 2000);
  Cloth cloth;
  for (int i = 0; i <= n + 1; ++i) add_particle(cloth, {double(i), 0, 0}, 0.5);
  for (int i = 0; i <= n; ++i) cloth.structural.push_back({i, i + 1, 1, 30});
  pin(cloth.particles, std::vector<int>{0, n + 1});
  const double exact = 1 / (std::sqrt(30 / 0.5) * std::sin(n * 3.14159265358979323846 / (2 * (n + 1))));
  const StepLimit rough = stable_step(cloth);
  CHECK(rough.residual <= 0.01);
  CHECK(rough.dt_limit <= exact);
  CHECK(rough.dt_limit >= 0.99 * exact);
  CHECK(rough.omega_max == Approx(2 / rough.dt_limit).epsilon(1e-15));
  if (n > 200) return;
  const StepLimit fine = stable_step(cloth, {.tolerance = 1e-9});
  CHECK(fine.residual <= 1e-9);
  CHECK(fine.dt_limit == Approx(exact).epsilon(1e-9));
}

TEST_CASE("stable_step: the limit is never above the exact one and within 2 % of it on irregular meshes",
          "[release]") {
  const double jitter = GENERATE(0.0, 0.2, 0.3, 0.45), stretch = GENERATE(1.0, 1.1, 0.95);
  for (int seed = 1; seed <= 6; ++seed) {
    Cloth cloth = sheet(9, 8, 0.05, jitter, seed, 1000, seed % 2 ? 10 : 300);
    Noise noise(seed);
    for (Vec3& x : cloth.particles.x) x = stretch * x + (stretch == 1 ? 0 : 2e-3) * noise.vector();
    if (seed % 3 == 0) pin(cloth.particles, std::vector<int>{0, 8, 40});
    const StepLimit limit = stable_step(cloth);
    const double positive = exact_limit(cloth, Stiffness::positive_part),
                 exact = exact_limit(cloth, Stiffness::exact);
    CAPTURE(jitter, stretch, seed, limit.iterations, limit.residual);
    CHECK(limit.dt_limit <= positive * (1 + 1e-9));
    CHECK(limit.dt_limit <= exact * (1 + 1e-9));
    CHECK(limit.dt_limit >= 0.98 * positive);
    CHECK(limit.dt_limit >= 0.98 * exact);
  }
}

TEST_CASE("stable_step: nothing stiff, no limit, and bad options are refused") {
  Cloth cloth;
  add_particle(cloth, {0, 0, 0}, 1);
  CHECK(std::isinf(stable_step(cloth).dt_limit));
  CHECK(std::isinf(stable_step(Cloth{}).dt_limit));
  CHECK_THROWS_AS(stable_step(cloth, {.tolerance = 0}), std::invalid_argument);
  CHECK_THROWS_AS(stable_step(cloth, {.max_iterations = 0}), std::invalid_argument);
}
