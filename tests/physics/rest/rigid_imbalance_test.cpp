// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/rest/rigid_imbalance.h"

#include <catch2/catch.hpp>

#include "physics/cloth/pins.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

std::vector<Vec3> weight(const Cloth& cloth, const Vec3& gravity = Vec3(0, -9.81, 0)) {
  std::vector<Vec3> load;
  for (const double m : cloth.particles.mass) load.push_back(m * gravity);
  return load;
}

}  // namespace

TEST_CASE("rigid_imbalance: pins leave six, three, one or no freedoms") {
  const auto freedoms = [](const std::vector<int>& pins) {
    Cloth cloth = sheet(5, 5, 0.1);
    pin(cloth.particles, pins);
    const auto found = rigid_imbalances(cloth, weight(cloth));
    return found.empty() ? 0 : found.at(0).freedoms;
  };
  CHECK(freedoms({}) == 6);
  CHECK(freedoms({7}) == 3);
  CHECK(freedoms({0, 4}) == 1);
  CHECK(freedoms({0, 1, 2, 3, 4}) == 1);
  CHECK(freedoms({0, 1, 20}) == 0);
}

TEST_CASE("rigid_imbalance: a mass beside its pin, a rod beside its axis and two pieces are out of balance") {
  Cloth cloth = pendulum(2, 50, 0.5, {0.3, -0.4, 0});
  auto found = rigid_imbalances(cloth, weight(cloth));
  REQUIRE(found.size() == 1);
  CHECK(found[0].moment.isApprox(Vec3(0, 0, -0.3 * 2 * 9.81)));
  CHECK(found[0].largest == Approx(9.81 * 0.6));  // g sin of the angle from below
  CHECK(found[0].force.isZero(0));
  std::vector<Vec3> rest = weight(cloth);
  remove_rigid_load(cloth, found[0], rest);
  CHECK(rest[1].isApprox(2 * 9.81 * 0.8 * Vec3(0.6, -0.8, 0)));  // what the spring bears

  add_particle(cloth, {1, 0, 0}, 1);
  add_particle(cloth, {2, 0, 0}, 3);
  cloth.structural.push_back({2, 3, 1, 10});
  found = rigid_imbalances(cloth, weight(cloth));
  REQUIRE(found.size() == 2);
  CHECK(found[1].freedoms == 6);
  CHECK(found[1].piece == std::vector<int>{2, 3});
  CHECK(found[1].point.isApprox(Vec3(1.75, 0, 0)));
  CHECK(found[1].acceleration.isApprox(Vec3(0, -9.81, 0)));
  CHECK(found[1].moment.norm() < 1e-12);
}

TEST_CASE("rigid_imbalance: what hangs on a line or a point is turned under it, and keeps its shape") {
  const Vec3 gravity(0, -9.81, 0);
  for (const std::vector<int>& pins : {std::vector<int>{0, 1, 2, 3, 4}, std::vector<int>{4}}) {
    Cloth cloth = sheet(5, 5, 0.1);
    pin(cloth.particles, pins);
    const Mat3 tilt = Eigen::AngleAxisd(2.5, Vec3(1, pins.size() == 1 ? 0.3 : 0, 0).normalized()).matrix();
    for (Vec3& x : cloth.particles.x) x = tilt * x;
    const std::vector<Vec3> before = cloth.particles.x;
    CHECK(rigid_imbalances(cloth, weight(cloth)).at(0).largest > 1);
    CHECK(balance_rigidly(cloth, gravity) > 1);
    CHECK(rigid_imbalances(cloth, weight(cloth)).at(0).largest < 1e-9);
    for (const int i : pins) CHECK((cloth.particles.x[i] - before[i]).norm() < 1e-12);
    for (const Spring& s : cloth.structural)
      CHECK((cloth.particles.x[s.b] - cloth.particles.x[s.a]).norm() == Approx(s.rest_length));
    CHECK(balance_rigidly(cloth, gravity) < 1e-12);
    double lowest = 0;  // below, not above
    for (std::size_t i = 0; i < before.size(); ++i) lowest += cloth.particles.x[i].y();
    CHECK(lowest < 0);
  }
}

TEST_CASE("rigid_imbalance: free pieces and axes along gravity are not turned, bad arrays refused") {
  Cloth cloth = sheet(4, 4, 0.1);
  const std::vector<Vec3> before = cloth.particles.x;
  CHECK(balance_rigidly(cloth, {0, -9.81, 0}) == 0);
  pin(cloth.particles, std::vector<int>{0, 1, 2, 3});
  CHECK(balance_rigidly(cloth, {-9.81, 0, 0}) == 0);
  CHECK(cloth.particles.x == before);
  CHECK_THROWS_AS(rigid_imbalances(cloth, std::vector<Vec3>(3)), std::invalid_argument);
  cloth.structural[0].b = 99;
  CHECK_THROWS_WITH(balance_rigidly(cloth, {0, 0, 0}), Catch::Contains("99"));
}
