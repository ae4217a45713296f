// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/pairs/pair_friction.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "physics/pairs/cloth_contact.h"
#include "tests/physics/pairs/random_pairs.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

/// A vertex over a face of two triangles, pushed by 2 N along z, at a range of 3 mm: a slip of 0.1 mm.
struct Pressed {
  std::vector<Vec3> x{{0.3, 0.2, 0.002}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  std::vector<ActivePair> active{pair(0)};

  static ActivePair pair(int face) {
    ActivePair p{};
    p.key = {0, 0, face};
    p.vertices = face ? std::array<int, 4>{0, 2, 4, 3} : std::array<int, 4>{0, 1, 2, 3};
    p.weights = {1, -0.5, -0.3, -0.2};
    p.normal = Vec3(0, 0, 1);
    p.push = 2;
    p.stiffness = 100;
    p.range = 0.003;
    return p;
  }
  std::vector<Vec3> forces(const PairFriction& friction) const {
    std::vector<Vec3> f(x.size(), Vec3::Zero());
    friction.add_forces(f);
    return f;
  }
};

constexpr double mu = 0.25, slip = 1e-4;

}  // namespace

TEST_CASE("pair_friction: it sticks by a spring, slides at friction times push, and acts on both sides") {
  Pressed p;
  PairFriction friction(mu);
  friction.look(p.x);
  friction.move_anchors(p.active, p.x);
  CHECK(p.forces(friction)[0].norm() == 0);
  p.x[0] += Vec3(0.4 * slip, 0, 0.001);
  friction.look(p.x);
  std::vector<Vec3> f = p.forces(friction);
  CHECK((f[0] - Vec3(-0.4 * mu * 2, 0, 0)).norm() < 1e-12);
  CHECK((f[1] + 0.5 * f[0]).norm() < 1e-15);
  CHECK((f[0] + f[1] + f[2] + f[3]).norm() < 1e-15);
  CHECK(friction.energy() == Approx(0.5 * 0.4 * 0.4 * slip * mu * 2));
  p.x[0].x() += 10 * slip;
  friction.look(p.x);
  CHECK(p.forces(friction)[0].x() == Approx(-mu * 2));
  friction.move_anchors(p.active, p.x);
  CHECK(friction.sliding() == 1);
  CHECK(p.forces(friction)[0].x() == Approx(-mu * 2));
  p.x[0].x() -= 0.5 * slip;  // back from where it slid to: the tether is a slip long
  friction.look(p.x);
  CHECK(p.forces(friction)[0].x() == Approx(-0.5 * mu * 2));
  friction.move_anchors({}, p.x);
  CHECK(friction.empty());
  CHECK(friction.energy() == 0);
  CHECK_THROWS_AS(PairFriction(-0.1), std::invalid_argument);
}

TEST_CASE("pair_friction: limits become those of the push after a move") {
  Pressed p;
  PairFriction friction(mu);
  friction.look(p.x);
  friction.move_anchors(p.active, p.x);
  p.x[0].y() += 2 * slip;
  friction.look(p.x);
  std::vector<Vec3> move(p.x.size(), Vec3::Zero());
  move[0].z() = -0.01;  // a hundred N/m: 1 N more
  friction.expect(p.active, move);
  CHECK(p.forces(friction)[0].y() == Approx(-mu * 3));
  move[0].z() = 0.1;
  friction.expect(p.active, move);
  CHECK(p.forces(friction)[0].norm() == 0);
  friction.expect({}, move);
  CHECK(friction.energy() == 0);
}

TEST_CASE("pair_friction: a pair that takes another's place goes on with its way, on its side alone") {
  for (const bool same_side : {true, false}) {
    Pressed p;
    PairFriction friction(mu);
    friction.look(p.x);
    friction.move_anchors(p.active, p.x);
    p.x[0] += Vec3(0.3 * slip, 0.6 * slip, 0);
    friction.look(p.x);
    std::vector<ActivePair> next{Pressed::pair(1)};
    if (!same_side) next[0].normal *= -1;
    friction.move_anchors(next, p.x);
    const Vec3 f = p.forces(friction)[0];
    CHECK((f - (same_side ? Vec3(-0.3 * mu * 2, -0.6 * mu * 2, 0) : Vec3(0, 0, 0))).norm() < 1e-12);
  }
  // An edge of the upper cloth, and a vertex of it that touched: the new pair has its way against the lower.
  Pressed p;
  PairFriction friction(mu);
  friction.look(p.x);
  friction.move_anchors(p.active, p.x);
  p.x[0].x() += 0.5 * slip;
  friction.look(p.x);
  ActivePair edges = Pressed::pair(0);
  edges.key = {1, 0, 7};
  edges.vertices = {1, 2, 0, 4};  // now the second primitive has vertex 0, and looks down
  edges.weights = {0.5, 0.5, -0.5, -0.5};
  edges.normal = Vec3(0, 0, -1);
  friction.move_anchors(std::vector<ActivePair>{edges}, p.x);
  CHECK(p.forces(friction)[0].x() == Approx(-0.5 * 0.5 * mu * 2));
}

TEST_CASE("pair_friction: a pair that is new on the way has friction from where the way began") {
  Pressed p;
  PairFriction friction(mu);
  const std::vector<Vec3> from = p.x;
  p.x[0].x() += 0.4 * slip;
  friction.hold_new(p.active, from);
  friction.look(p.x);
  CHECK(p.forces(friction)[0].x() == Approx(-0.4 * mu * 2));

  PairFriction known(mu);  // with what the pair before it had where the way began
  known.look(from);
  known.move_anchors(p.active, from);
  p.x[0].x() = from[0].x() + 0.3 * slip;
  known.look(p.x);
  known.move_anchors(p.active, p.x);
  const std::vector<Vec3> middle = p.x;
  p.x[0].x() += 0.2 * slip;
  known.hold_new(std::vector<ActivePair>{Pressed::pair(1)}, middle);
  known.look(p.x);
  known.expect(std::vector<ActivePair>{Pressed::pair(1)}, std::vector<Vec3>(p.x.size(), Vec3::Zero()));
  CHECK(p.forces(known)[0].x() == Approx(-0.5 * mu * 2));  // of the new pair alone
}

TEST_CASE("pair_friction: what its anchors say brings back the same forces") {
  Pressed p;
  PairFriction friction(mu), other(mu);
  friction.look(p.x);
  friction.move_anchors(p.active, p.x);
  p.x[0].x() += 3 * slip;
  friction.look(p.x);
  friction.move_anchors(p.active, p.x);
  other.set_anchors(friction.anchors(), p.active);
  CHECK(other.sliding() == 1);
  p.x[0] += Vec3(-0.3 * slip, 0.1 * slip, 0);
  friction.look(p.x);
  other.look(p.x);
  CHECK(p.forces(friction) == p.forces(other));
  CHECK(p.forces(other)[0].norm() > 0);
  other.set_anchors(friction.anchors(), {});
  CHECK(other.empty());
}

TEST_CASE("pair_friction: with contact its forces are the derivative of the energy, its stiffness theirs") {
  const Cloth base = rough_sheet(6, 0.03, 3);
  Cloth cloth = base;
  for (const Vec3& at : base.particles.x) add_particle(cloth, at + Vec3(0.013, 0.021, 0.017), 0.01);
  for (auto t : base.triangles) cloth.triangles.push_back({t[0] + 49, t[1] + 49, t[2] + 49});
  std::vector<Vec3> start = cloth.particles.x, x = start;
  for (std::size_t i = 49; i < x.size(); ++i) start[i].z() += 0.2;
  ClothContact contact(cloth, {0.02, 300, 0.4}, start, {});
  contact.look(x, nullptr);
  contact.move_anchors(x);
  Noise noise(4);
  for (Vec3& p : x) p += 1e-3 * noise.vector();
  contact.look(x, nullptr);
  REQUIRE(contact.touching() > 50);
  std::vector<Vec3> force(x.size(), Vec3::Zero());
  contact.add_forces(force);
  Vec3 sum = Vec3::Zero();
  double largest = 0;
  for (const Vec3& f : force) sum += f, largest = std::max(largest, f.norm());
  CHECK(sum.norm() < 1e-12 * largest);
  for (std::size_t i = 0; i < x.size(); i += 5)
    for (int axis = 0; axis < 3; ++axis) {
      double energy[2];
      const double before = x[i][axis];
      for (const int side : {0, 1}) {
        x[i][axis] = before + (side ? 1e-7 : -1e-7);
        contact.look(x, nullptr);
        energy[side] = contact.energy();
      }
      x[i][axis] = before;
      CHECK(force[i][axis] == Approx((energy[0] - energy[1]) / 2e-7).margin(2e-4 * largest));
    }
  contact.look(x, nullptr);
  contact.move_anchors(x);
  CHECK(contact.sliding() > 10);
  FreeStiffness stiffness(cloth);
  contact.couple(stiffness);
  Cloth soft = cloth;
  for (MembraneTriangle& t : soft.membrane) t.lambda = t.mu = 0;
  stiffness.assemble(soft, x, Stiffness::positive_part);
  contact.add_stiffness(stiffness);
  CHECK(stiffness.factorise_definite(1e-6));
}
