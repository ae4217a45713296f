// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/cloth/spring_forces.h"

#include <catch2/catch.hpp>

#include "tests/physics/cloth/one_kind.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

/// A small mesh, crumpled in space, so that springs are stretched and compressed in all directions.
Cloth crumpled_springs(std::uint64_t seed) {
  Cloth cloth = sheet(4, 3, 0.1, 0.2, seed);
  Noise noise(seed + 100);
  for (Vec3& x : cloth.particles.x) x += 0.04 * noise.vector();
  return cloth;
}

}  // namespace

TEST_CASE("spring_forces: a stretched spring pulls its ends together with k (l - L)") {
  const std::vector<Vec3> x{{0, 0, 0}, {0, 3, 4}};
  const std::vector<Spring> springs{{0, 1, 4.5, 100}};
  std::vector<Vec3> force(2, Vec3::Zero());
  add_forces(only(springs), x, force);
  CHECK((force[0] - Vec3(0, 30, 40)).norm() < 1e-12);
  CHECK(force[1] == -force[0]);
  CHECK(potential_energy(only(springs), x) == Approx(12.5).epsilon(1e-15));
}

TEST_CASE("spring_forces: the springs' force is minus the gradient of their energy") {
  const Cloth cloth = crumpled_springs(GENERATE(1, 2, 3));
  std::vector<Vec3> force(cloth.particles.size(), Vec3::Zero()), x = cloth.particles.x;
  add_forces(only(cloth.structural), x, force);
  const double h = 1e-6;
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double at = x[i][c];
      x[i][c] = at + h;
      const double above = potential_energy(only(cloth.structural), x);
      x[i][c] = at - h;
      const double below = potential_energy(only(cloth.structural), x);
      x[i][c] = at;
      CHECK(std::abs(force[i][c] + (above - below) / (2 * h)) < 2e-7 * 1000 * 0.1);
    }
  }
}

TEST_CASE("spring_forces: the stiffness product is the derivative of the force") {
  const Cloth cloth = crumpled_springs(GENERATE(4, 5, 6));
  const std::size_t n = cloth.particles.size();
  Noise noise(9);
  std::vector<Vec3> u(n), ku(n, Vec3::Zero()), above(n, Vec3::Zero()), below = above, x = cloth.particles.x;
  for (Vec3& v : u) v = noise.vector();
  add_spring_stiffness_product(x, cloth.structural, u, Stiffness::exact, ku);
  const double h = 1e-7;
  for (std::size_t i = 0; i < n; ++i) x[i] = cloth.particles.x[i] + h * u[i];
  add_forces(only(cloth.structural), x, above);
  for (std::size_t i = 0; i < n; ++i) x[i] = cloth.particles.x[i] - h * u[i];
  add_forces(only(cloth.structural), x, below);
  for (std::size_t i = 0; i < n; ++i) CHECK((ku[i] + (above[i] - below[i]) / (2 * h)).norm() < 1e-3);
}

TEST_CASE("spring_forces: the positive part of the stiffness is at least 0 and at least the exact one") {
  const Cloth cloth = crumpled_springs(7);
  const std::size_t n = cloth.particles.size();
  Noise noise(11);
  double compressed = 0;
  for (int round = 0; round < 200; ++round) {
    std::vector<Vec3> u(n), exact(n, Vec3::Zero()), positive = exact;
    for (Vec3& v : u) v = noise.vector();
    add_spring_stiffness_product(cloth.particles.x, cloth.structural, u, Stiffness::exact, exact);
    add_spring_stiffness_product(cloth.particles.x, cloth.structural, u, Stiffness::positive_part, positive);
    double e = 0, p = 0;
    for (std::size_t i = 0; i < n; ++i) e += u[i].dot(exact[i]), p += u[i].dot(positive[i]);
    CHECK(p >= 0);
    CHECK(p >= e);
    compressed = std::max(compressed, p - e);
  }
  CHECK(compressed > 1);
}

TEST_CASE("spring_forces: a spring of length 0 exerts no force, and a spring out of range is refused") {
  const std::vector<Vec3> x(2, Vec3(1, 2, 3));
  std::vector<Vec3> force(2, Vec3::Zero());
  add_forces(only(std::vector<Spring>{{0, 1, 0.1, 10}}), x, force);
  CHECK(force[0] == Vec3::Zero());
  CHECK_THROWS_AS(add_forces(only(std::vector<Spring>{{0, 2, 0.1, 10}}), x, force), std::invalid_argument);
  force.resize(3);
  CHECK_THROWS_AS(add_forces(only(std::vector<Spring>{{0, 1, 0.1, 10}}), x, force), std::invalid_argument);
}
