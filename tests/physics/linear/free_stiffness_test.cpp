// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/linear/free_stiffness.h"

#include <catch2/catch.hpp>

#include "physics/cloth/pins.h"
#include "tests/physics/cloth/finite_differences.h"
#include "tests/physics/cloth/shell_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

/// All kinds of elements, crumpled, three particles held.
Cloth crumpled(double crumple) {
  Cloth cloth = sheet(4, 4, 0.1, 0.2, 3, 300, 40);
  add_membrane(cloth, 500);
  add_hinges(cloth, 0.01);
  pin(cloth.particles, std::vector<int>{0, 5, 15});
  Noise noise(4);
  for (Vec3& x : cloth.particles.x) x += crumple * noise.vector();
  return cloth;
}

Eigen::MatrixXd dense(const Cloth& cloth, Stiffness stiffness) {
  const Eigen::MatrixXd all = stiffness_matrix(cloth, cloth.particles.x, stiffness);
  std::vector<int> kept;
  for (int i = 0; i < int(cloth.particles.size()); ++i) {
    if (cloth.particles.inv_mass[i] > 0) kept.insert(kept.end(), {3 * i, 3 * i + 1, 3 * i + 2});
  }
  return all(kept, kept);
}

}  // namespace

TEST_CASE("free_stiffness: solutions, signs and scale agree with the dense matrix") {
  for (const double crumple : {0.002, 0.03}) {
    const Cloth cloth = crumpled(crumple);
    FreeStiffness k(cloth);
    for (const Stiffness stiffness : {Stiffness::exact, Stiffness::positive_part}) {
      const Eigen::MatrixXd matrix = dense(cloth, stiffness);
      const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues();
      k.assemble(cloth, cloth.particles.x, stiffness);
      CHECK(k.free_particles() == 13);
      CHECK(k.mean_diagonal() == Approx(matrix.diagonal().mean()));
      for (const double shift : {1e-3, -0.5 * (values[9] + values[10]), 2 * std::abs(values[0])}) {
        CAPTURE(crumple, shift);
        k.assemble(cloth, cloth.particles.x, stiffness);
        for (int i = 0; i < 16; ++i) k.add(i, shift * Mat3::Identity());
        CHECK(k.negative_eigenvalues() == int((values.array() + shift < 0).count()));
      }
      k.assemble(cloth, cloth.particles.x, stiffness);
      Noise noise(7);
      std::vector<Vec3> b(cloth.particles.size());
      for (Vec3& v : b) v = noise.vector();
      CHECK_FALSE(k.factorise_definite(-0.5 * (values[9] + values[10])));
      REQUIRE(k.factorise_definite(2 * std::abs(values[0])));
      std::vector<Vec3> u = b;
      k.solve(u);
      CHECK(u[5] == Vec3::Zero());
      Eigen::VectorXd right(39), solution(39);
      for (int i = 0, row = 0; i < 16; ++i) {
        if (!(cloth.particles.inv_mass[i] > 0)) continue;
        right.segment<3>(3 * row) = b[i];
        solution.segment<3>(3 * row++) = u[i];
      }
      const Eigen::VectorXd rest = matrix * solution + 2 * std::abs(values[0]) * solution - right;
      CHECK(rest.norm() < 1e-9 * right.norm());
    }
  }
}

TEST_CASE("free_stiffness: single precision solves within what is asked, or leaves the force as it was") {
  const Cloth cloth = crumpled(0.002);
  FreeStiffness k(cloth);
  k.assemble(cloth, cloth.particles.x, Stiffness::positive_part);
  for (int i = 0; i < 16; ++i) k.add(i, Mat3::Identity());
  Noise noise(7);
  std::vector<Vec3> b(cloth.particles.size());
  for (std::size_t i = 0; i < b.size(); ++i)
    b[i] = cloth.particles.inv_mass[i] > 0 ? noise.vector() : Vec3::Zero();
  REQUIRE(k.factorise_single());
  const auto left_of = [&](const std::vector<Vec3>& x) {
    const std::vector<Vec3> product = k.times(x);
    double rest = 0, whole = 0;
    for (std::size_t i = 0; i < b.size(); ++i) {
      rest += (product[i] - b[i]).squaredNorm();
      whole += b[i].squaredNorm();
    }
    return std::sqrt(rest / whole);
  };
  std::vector<Vec3> once = b, twice = b, never = b;
  k.solve(once);
  const double first = left_of(once);
  REQUIRE(first > 1e-9);
  REQUIRE(k.solve_within(1e-2 * first, twice));
  CHECK(left_of(twice) <= 1e-2 * first);
  CHECK_FALSE(k.solve_within(0, never));
  CHECK(never == b);
}

TEST_CASE("free_stiffness: blocks that are added count until the next assembly") {
  Cloth cloth = crumpled(0);
  FreeStiffness k(cloth);
  k.assemble(cloth, cloth.particles.x, Stiffness::positive_part);
  const double mean = k.mean_diagonal();
  const Mat3 block = 1e4 * (Mat3::Identity() + 0.5 * Mat3::Ones());
  for (int i = 0; i < 16; ++i) k.add(i, block);  // pins take none
  CHECK(k.mean_diagonal() == Approx(mean + 1.5e4));
  REQUIRE(k.factorise_definite());
  Eigen::MatrixXd matrix = dense(cloth, Stiffness::positive_part);
  for (int i = 0; i < 13; ++i) matrix.block<3, 3>(3 * i, 3 * i) += block;
  std::vector<Vec3> u(16, Vec3(1, 2, 3));
  k.solve(u);
  const Eigen::VectorXd exact = matrix.llt().solve(Vec3(1, 2, 3).replicate(13, 1));
  CHECK((u[1] - exact.head<3>()).norm() < 1e-12 * exact.norm());
  k.assemble(cloth, cloth.particles.x, Stiffness::positive_part);
  CHECK(k.mean_diagonal() == mean);
}

TEST_CASE("free_stiffness: nothing free, and a cloth that changed, are told") {
  Cloth cloth = crumpled(0);
  FreeStiffness k(cloth);
  cloth.hinges.pop_back();
  CHECK_THROWS_AS(k.assemble(cloth, cloth.particles.x, Stiffness::exact), std::invalid_argument);
  for (int i = 0; i < 5; ++i) cloth.structural.push_back(cloth.structural.back());
  CHECK_THROWS_AS(k.assemble(cloth, cloth.particles.x, Stiffness::exact), std::invalid_argument);
  for (double& w : cloth.particles.inv_mass) w = 0;
  FreeStiffness none(cloth);
  none.assemble(cloth, cloth.particles.x, Stiffness::exact);
  CHECK(none.negative_eigenvalues() == 0);
  CHECK(none.factorise_definite());
  CHECK(none.mean_diagonal() == 0);
  std::vector<Vec3> b(cloth.particles.size(), Vec3::Ones());
  none.solve(b);
  CHECK(b[3] == Vec3::Zero());
  cloth.particles.inv_mass.pop_back();
  CHECK_THROWS_AS(FreeStiffness(cloth), std::invalid_argument);
}

TEST_CASE("free_stiffness: it has the same bits on any number of threads") {
  Cloth cloth = sheet(40, 30, 0.02, 0.2, 3, 300, 40);
  add_membrane(cloth, 500);
  add_hinges(cloth, 0.01);
  pin(cloth.particles, std::vector<int>{0, 39});
  Noise noise(4);
  for (Vec3& x : cloth.particles.x) x += 0.001 * noise.vector();
  std::vector<Vec3> right(cloth.particles.size()), first;
  for (Vec3& v : right) v = noise.vector();
  double mean = 0;
  for (int threads = 1; threads <= 5; threads += 2) {
    ThreadPool pool(threads);
    ThreadPool* const shared = threads > 1 ? &pool : nullptr;
    FreeStiffness k(cloth);
    k.assemble(cloth, cloth.particles.x, {0.5}, shared);
    REQUIRE(k.factorise_definite(500, shared));
    std::vector<Vec3> u = right;
    k.solve(u, shared);
    if (threads == 1) first = u, mean = k.mean_diagonal();
    CHECK(k.mean_diagonal() == mean);
    CHECK(u == first);
    k.factorise_definite(500);  // of another division of the work
    u = right;
    k.solve(u, shared);
    CHECK(u == first);
  }
}

TEST_CASE(
    "free_stiffness: what is coupled beside elements counts, and where it was ordered before it has the same "
    "bits") {
  const Cloth cloth = crumpled(0.002);
  const std::span<const Vec3> x = cloth.particles.x;
  const FreeStiffness::Pairs first{{1, 14}}, second{{1, 14}, {2, 13}, {5, 9}, {2, 3}};
  const auto fill = [&](FreeStiffness& k, const FreeStiffness::Pairs& pairs) {
    k.assemble(cloth, x, Stiffness::positive_part);
    for (int i = 0; i < 16; ++i) k.add(i, 50 * Mat3::Identity());
    for (const auto& [i, j] : pairs) k.add(i, j, (0.1 * (i + 1)) * Mat3::Ones());
    REQUIRE(k.factorise_definite());
  };
  std::vector<Vec3> b(cloth.particles.size(), Vec3(1, 2, -3));
  FreeStiffness k(cloth);
  k.couple(first);
  fill(k, first);
  CHECK(k.ordered_for() == first);
  k.couple(second);
  CHECK(k.couples(2, 13));
  fill(k, second);
  std::vector<Vec3> u = b;
  k.solve(u);
  const std::vector<Vec3> back = k.times(u);
  for (int i = 0; i < 16; ++i)
    if (cloth.particles.inv_mass[std::size_t(i)] > 0)
      CHECK((back[std::size_t(i)] - b[std::size_t(i)]).norm() < 1e-10);
  FreeStiffness resumed(cloth);
  resumed.order_for(k.ordered_for());
  resumed.couple(second);
  fill(resumed, second);
  std::vector<Vec3> v = b;
  resumed.solve(v);
  CHECK(u == v);
  k.couple({});
  CHECK_FALSE(k.couples(2, 13));
}
