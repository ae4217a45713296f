// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <vector>

#include "physics/body/collider.h"

using namespace furrow::physics;

namespace {

struct UnitBall : Collider {
  SignedDistance at(const Vec3& x) const override { return {x.norm() - 1, x.normalized()}; }
};

}  // namespace

TEST_CASE("push_out: it brings the named points to the level along the gradient, and leaves the others") {
  std::vector<Vec3> x{{0.5, 0, 0}, {0, 0.9, 0}, {0, 0, 2}, {0.1, 0, 0}};
  const std::vector<int> which{0, 1, 2};
  const PushOutReport report = push_out(x, which, UnitBall(), 0.1);
  CHECK((x[0] - Vec3(1.1, 0, 0)).norm() < 1e-8);
  CHECK((x[1] - Vec3(0, 1.1, 0)).norm() < 1e-8);
  CHECK(x[2] == Vec3(0, 0, 2));
  CHECK(x[3] == Vec3(0.1, 0, 0));
  CHECK(report.moved == 2);
  CHECK(report.farthest == Approx(0.6));
  CHECK(report.still_inside == 0);
}

TEST_CASE("push_out: it refuses an index out of range before anything moves") {
  std::vector<Vec3> x{{0.5, 0, 0}};
  const std::vector<int> which{0, 1};
  CHECK_THROWS_AS(push_out(x, which, UnitBall()), std::invalid_argument);
  CHECK(x[0] == Vec3(0.5, 0, 0));
}

TEST_CASE("bring_out: free particles come out to the gap, and pins stay") {
  Particles p;
  p.x = {{0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 2}};
  p.v.assign(3, Vec3::Zero());
  p.mass.assign(3, 1);
  p.inv_mass = {1, 0, 1};
  const PushOutReport report = bring_out(p, UnitBall(), 0.1);
  CHECK((p.x[0] - Vec3(1.1, 0, 0)).norm() < 1e-8);
  CHECK(p.x[1] == Vec3(0, 0.5, 0));
  CHECK(p.x[2] == Vec3(0, 0, 2));
  CHECK(report.moved == 1);
}
