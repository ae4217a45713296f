// SPDX-License-Identifier: MIT
#include "physics/cloth/join_cloths.h"

#include <catch2/catch.hpp>

#include "physics/cloth/elements.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

/// Pulls every particle to the origin.
class PullHome : public Energy {
 public:
  double energy(std::span<const Vec3> x) const override {
    double sum = 0;
    for (const Vec3& p : x) sum += 0.5 * p.squaredNorm();
    return sum;
  }
  void add_forces(std::span<const Vec3> x, std::span<Vec3> force) const override {
    for (std::size_t i = 0; i < x.size(); ++i) force[i] -= x[i];
  }
  bool add_stiffness(std::span<const Vec3> x, Stiffness, const BlockSink& sink) const override {
    for (std::size_t i = 0; i < x.size(); ++i) sink(int(i), int(i), Mat3::Identity());
    return true;
  }
};

Cloth pulled_triangle(double at) {
  Cloth cloth;
  for (const Vec3& x : {Vec3(at, 0, 0), Vec3(at + 1.1, 0, 0), Vec3(at, 1.2, 0), Vec3(at + 1, 1, 0.3)})
    add_particle(cloth, x, 0.01);
  cloth.triangles = {{0, 1, 2}, {1, 3, 2}};
  cloth.structural = {{0, 1, 1, 10}, {1, 2, 1.4, 10}};
  cloth.tension = {{0, 2, 1, 5, 1}};
  cloth.membrane = {{{0, 1, 2}, {1.4, 1, 1}, 100, 100}};
  cloth.hinges = {{{1, 2, 0, 3}, 0.1, 0.01}};
  cloth.energies = {std::make_shared<PullHome>()};
  return cloth;
}

}  // namespace

TEST_CASE("join_cloths: forces are those of each cloth, bit by bit") {
  const std::array<Cloth, 2> two{pulled_triangle(0), pulled_triangle(3)};
  const Cloth all = join_cloths(two);
  REQUIRE(all.particles.size() == 8);
  REQUIRE(all.triangles.back() == std::array<int, 3>{5, 7, 6});
  std::vector<Vec3> force(8, Vec3::Zero());
  add_forces(all, all.particles.x, force);
  for (std::size_t c = 0; c < 2; ++c) {
    std::vector<Vec3> own(4, Vec3::Zero());
    add_forces(two[c], two[c].particles.x, own);
    for (std::size_t i = 0; i < 4; ++i) CHECK(force[4 * c + i] == own[i]);
  }
  std::vector<int> rows;
  all.energies[1]->add_stiffness(all.particles.x, Stiffness::exact,
                                 [&](int i, int, const Mat3&) { rows.push_back(i); });
  CHECK(rows == std::vector<int>{4, 5, 6, 7});
}

TEST_CASE("join_cloths: hinges of several laws are refused") {
  std::array<Cloth, 2> two{pulled_triangle(0), pulled_triangle(3)};
  two[1].hinge_law = HingeLaw::cosine;
  CHECK_THROWS_AS(join_cloths(two), std::invalid_argument);
  two[1].hinges.clear();
  CHECK(join_cloths(two).hinge_law == HingeLaw::linear);
}
