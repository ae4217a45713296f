// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/pairs/cloth_contact.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/physics/pairs/random_pairs.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

constexpr ClothContactOptions thick{0.02, 300};

/// Two rough sheets, the second over the first by some of the thickness.
Cloth two_sheets(double apart, std::uint64_t seed, double turn = 0) {
  Cloth cloth = rough_sheet(6, 0.03, seed);
  const Cloth other = rough_sheet(5, 0.03, seed + 50);
  const int n = int(cloth.particles.size());
  const Eigen::AngleAxisd turned(turn, Vec3::UnitZ());
  for (const Vec3& x : other.particles.x) add_particle(cloth, turned * x + Vec3(0.013, 0.021, apart), 0.01);
  for (auto t : other.triangles) cloth.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  for (auto t : other.membrane) {
    for (int& v : t.vertices) v += n;
    cloth.membrane.push_back(t);
  }
  return cloth;
}

}  // namespace

TEST_CASE("cloth_contact: forces are the derivative of the energy, and sum to 0") {
  const Cloth cloth = two_sheets(0.022, 3);
  ClothContact contact(cloth, thick, two_sheets(0.2, 3).particles.x, {});
  std::vector<Vec3> x = cloth.particles.x;
  contact.look(x, nullptr);
  CHECK(contact.touching() > 50);
  CHECK(contact.nearest() < 0.02);
  std::vector<Vec3> force(x.size(), Vec3::Zero());
  contact.add_forces(force);
  Vec3 sum = Vec3::Zero(), torque = sum;
  double largest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum += force[i];
    torque += x[i].cross(force[i]);
    largest = std::max(largest, force[i].norm());
  }
  CHECK(sum.norm() < 1e-12 * largest);
  CHECK(torque.norm() < 1e-12 * largest);
  for (std::size_t i = 0; i < x.size(); i += 3)
    for (int axis = 0; axis < 3; ++axis) {
      const double before = x[i][axis];
      double energy[2];
      for (const int side : {0, 1}) {
        x[i][axis] = before + (side ? 1e-7 : -1e-7);
        contact.look(x, nullptr);
        energy[side] = contact.energy();
      }
      x[i][axis] = before;
      CHECK(force[i][axis] == Approx((energy[0] - energy[1]) / 2e-7).margin(2e-4 * largest));
    }
}

TEST_CASE("cloth_contact: its answers have the same bits for any number of threads and any list") {
  const Cloth cloth = two_sheets(0.021, 5);
  const std::vector<Vec3> start = two_sheets(0.2, 5).particles.x;
  ThreadPool two(2);
  ClothContact a(cloth, thick, start, {}), b(cloth, thick, start, {}, &two);
  // b has a list with a plan, made elsewhere; a makes its own here.
  std::vector<Vec3> way(start.size());
  for (std::size_t i = 0; i < start.size(); ++i) way[i] = 1.01 * (cloth.particles.x[i] - start[i]);
  b.safe_share(start, way, 1, &two);
  a.look(cloth.particles.x, nullptr);
  b.look(cloth.particles.x, &two);
  CHECK(b.list_builds() == 1);
  CHECK(a.touching() == b.touching());
  CHECK(a.energy() == b.energy());
  CHECK(a.energy() > 0);
  std::vector<Vec3> fa(start.size(), Vec3::Zero()), fb = fa;
  a.add_forces(fa);
  b.add_forces(fb);
  CHECK(fa == fb);
  CHECK(a.safe_share(cloth.particles.x, way, 1, nullptr) == b.safe_share(cloth.particles.x, way, 1, &two));
}

TEST_CASE("cloth_contact: a safe share of any move leaves no crossing, the whole of it would", "[long]") {
  int cut = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::vector<Vec3> start = two_sheets(0.1, seed).particles.x;
    const Cloth cloth = two_sheets(0.1, seed);
    ClothContact contact(cloth, thick, start, {});
    Noise noise(seed);
    std::vector<Vec3> x = start;
    for (int step = 0; step < 10; ++step) {
      std::vector<Vec3> way(x.size());
      for (std::size_t i = 0; i < x.size(); ++i)
        way[i] = Vec3(0, 0, i < 49 ? 0.1 : -0.1) + 0.1 * noise.vector();
      const double share = contact.safe_share(x, way, 1, nullptr);
      std::vector<Vec3> whole = x;
      for (std::size_t i = 0; i < x.size(); ++i) {
        whole[i] += way[i];
        x[i] += share * way[i];
      }
      cut += share < 1 && !edge_face_crossings(contact.mesh(), whole).empty();
      REQUIRE(edge_face_crossings(contact.mesh(), x).empty());
    }
  }
  CHECK(cut > 100);
}

TEST_CASE("cloth_contact: an approach ends where it was to, but for what something is in the way of") {
  const std::vector<Vec3> start = two_sheets(0.1, 2).particles.x;
  const Cloth cloth = two_sheets(0.1, 2);
  ClothContact contact(cloth, thick, start, {});
  std::vector<Vec3> x = start, to = start;
  for (Vec3& p : to) p += Vec3(0.5, 0.2, 0.3);
  CHECK(contact.approach(x, to, nullptr) == 0);
  CHECK(x == to);
  to[49 + 14].z() -= 0.2;  // one vertex of the upper sheet, through the lower one
  const int left = contact.approach(x, to, nullptr);
  CHECK(left >= 1);
  CHECK(left < 10);
  CHECK(edge_face_crossings(contact.mesh(), x).empty());
  CHECK(x[49 + 14].z() < to[49 + 14].z() + 0.15);
}

TEST_CASE("cloth_contact: where an approach ends does not hang on what else is listed", "[long]") {
  int stopped = 0;
  for (std::uint64_t seed = 1; seed < 9; ++seed) {
    const Cloth cloth = two_sheets(0.05, seed);
    const std::vector<Vec3>& start = cloth.particles.x;
    ClothContact lists_from_before(cloth, {0.002, 300}, start, {});
    std::vector<Vec3> x = start;
    for (int step = 0; step < 150; ++step) {
      std::vector<Vec3> to = x, reached = x;
      for (std::size_t i = 49; i < to.size(); ++i) to[i].z() -= 0.0005;
      ClothContact lists_anew(cloth, {0.002, 300}, start, {});
      const int left = lists_anew.approach(reached, to, nullptr);
      REQUIRE(lists_from_before.approach(x, to, nullptr) == left);
      REQUIRE(x == reached);
      stopped += left > 0;
    }
  }
  CHECK(stopped > 100);
}

TEST_CASE("cloth_contact: what starts or was drawn nearer than its range is not pushed, but grows to it") {
  const Cloth cloth = two_sheets(0.022, 7);
  const auto& x = cloth.particles.x;
  ClothContact contact(cloth, thick, x, {}), drawn(cloth, thick, x, x);
  contact.look(x, nullptr);
  drawn.look(x, nullptr);
  CHECK(contact.touching() == 0);
  CHECK(drawn.touching() == 0);
  CHECK_FALSE(drawn.widen(x));
  int rounds = 0;
  while (contact.widen(x)) ++rounds;
  CHECK(rounds > 0);
  contact.look(x, nullptr);
  CHECK(contact.touching() > 50);
  ClothContact apart(cloth, thick, two_sheets(0.2, 7).particles.x, {});
  apart.look(x, nullptr);
  CHECK(apart.energy() == contact.energy());
}

TEST_CASE("cloth_contact: what was drawn near is pushed where it was drawn through cloth, and there alone") {
  const Cloth cloth = two_sheets(0.022, 7);
  const auto& x = cloth.particles.x;
  std::vector<Vec3> drawn = x;
  drawn[49].z() = -0.05;  // a corner of the upper sheet, through the lower one
  ClothContact none(cloth, thick, x, {}), crossed(cloth, thick, x, drawn);
  REQUIRE_FALSE(edge_face_crossings(crossed.mesh(), drawn).empty());
  int rounds = 0;
  while (crossed.widen(x)) ++rounds;
  CHECK(rounds > 0);
  while (none.widen(x)) continue;
  crossed.look(x, nullptr);
  none.look(x, nullptr);
  CHECK(crossed.touching() > 0);
  CHECK(crossed.touching() < none.touching());
}

TEST_CASE("cloth_contact: what crosses at the start is exempt until it is apart, its neighbours are not") {
  Cloth cloth = two_sheets(0.05, 9);
  const std::vector<Vec3> apart = cloth.particles.x;
  std::vector<Vec3> pierced = apart;
  pierced[49 + 14].z() = -0.05;  // of the upper sheet, through the lower one
  ClothContact contact(cloth, thick, pierced, {});
  CHECK(contact.crossed_at_start() > 0);
  CHECK(contact.exempt() > 0);
  contact.look(pierced, nullptr);
  CHECK(std::isfinite(contact.energy()));
  // The way back is free, step by step, while another place is guarded.
  std::vector<Vec3> x = pierced;
  for (int i = 0; i < 200 && x[49 + 14] != apart[49 + 14]; ++i) {
    std::vector<Vec3> way(apart.size(), Vec3::Zero());
    way[49 + 14] = apart[49 + 14] - x[49 + 14];
    const double share = contact.safe_share(x, way, 1, nullptr);
    x[49 + 14] = share == 1 ? apart[49 + 14] : Vec3(x[49 + 14] + share * way[49 + 14]);
    contact.widen(x);
  }
  CHECK(x == apart);
  std::vector<Vec3> down(apart.size(), Vec3::Zero());
  down[49 + 35] = Vec3(0, 0, -0.1);
  CHECK(contact.safe_share(pierced, down, 1, nullptr) < 1);
  contact.widen(apart);
  CHECK(contact.exempt() == 0);
}

TEST_CASE("cloth_contact: cloth of two groups passes through each other, cloth of one does not") {
  const Cloth cloth = two_sheets(0.022, 3);
  const std::size_t n = cloth.particles.size();
  std::vector<int> groups(n, 0);
  std::fill(groups.begin() + 49, groups.end(), 1);
  ClothContactOptions apart = thick, together = thick;
  apart.groups = groups;
  const std::vector<int> one(n, 5);
  together.groups = one;
  const std::vector<Vec3> start = two_sheets(0.2, 3).particles.x;
  ClothContact free(cloth, apart, start, {}), kept(cloth, together, start, {});
  std::vector<Vec3> move(n, Vec3::Zero());
  std::fill(move.begin() + 49, move.end(), Vec3(0, 0, -0.4));
  CHECK(free.safe_share(start, move, 1, nullptr) == 1);
  CHECK(kept.safe_share(start, move, 1, nullptr) < 0.6);
  free.look(cloth.particles.x, nullptr);
  kept.look(cloth.particles.x, nullptr);
  CHECK(free.touching() == 0);
  CHECK(kept.touching() > 50);
  const Cloth crossed = two_sheets(0, 3);
  CHECK(ClothContact(crossed, apart, crossed.particles.x, {}).crossed_at_start() == 0);
  CHECK(ClothContact(crossed, together, crossed.particles.x, {}).crossed_at_start() > 20);
  groups.pop_back();
  apart.groups = groups;
  CHECK_THROWS_AS(ClothContact(cloth, apart, start, {}), std::invalid_argument);
}

TEST_CASE("cloth_contact: its stiffness is semidefinite") {
  Cloth cloth = two_sheets(0.015, 11, 0.3);
  ClothContact contact(cloth, thick, two_sheets(0.2, 11, 0.3).particles.x, {});
  contact.look(cloth.particles.x, nullptr);
  CHECK(contact.touching() > 50);
  FreeStiffness stiffness(cloth);
  contact.couple(stiffness);
  Cloth soft = cloth;
  for (MembraneTriangle& t : soft.membrane) t.lambda = t.mu = 0;
  stiffness.assemble(soft, soft.particles.x, Stiffness::positive_part);
  contact.add_stiffness(stiffness);
  CHECK(stiffness.mean_diagonal() > 1);
  CHECK(stiffness.factorise_definite(1e-6));
  CHECK_THROWS_AS(ClothContact(cloth, {0, 1}, cloth.particles.x, {}), std::invalid_argument);
  CHECK_THROWS_AS(ClothContact(cloth, {1, 0}, cloth.particles.x, {}), std::invalid_argument);
}

TEST_CASE("cloth_contact: its stiffness is the change of forces of a vertex over a face") {
  Cloth cloth;
  for (const Vec3& x :
       {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0.3, 0.2, 0.015), Vec3(0, 0, 0.9), Vec3(1, 1, 0.9)})
    add_particle(cloth, x, 0.01);
  cloth.triangles = {{0, 1, 2}, {3, 4, 5}};
  std::vector<Vec3> start = cloth.particles.x, up(6, Vec3::Zero());
  start[3].z() = 0.1;
  ClothContact contact(cloth, thick, start, {});
  up[0] = up[1] = up[2] = Vec3(0, 0, -0.4), up[3] = Vec3(0, 0, 1);
  std::vector<Vec3> change(6, Vec3::Zero());
  const double step = 1e-7, shift = 1;
  for (const double side : {-1.0, 1.0}) {
    std::vector<Vec3> x = cloth.particles.x, force(6, Vec3::Zero());
    for (std::size_t i = 0; i < 6; ++i) x[i] += side * step * up[i];
    contact.look(x, nullptr);
    REQUIRE(contact.touching() == 1);
    contact.add_forces(force);
    for (std::size_t i = 0; i < 6; ++i) change[i] -= side / (2 * step) * force[i];
  }
  FreeStiffness stiffness(cloth);
  contact.couple(stiffness);
  stiffness.assemble(cloth, cloth.particles.x, Stiffness::exact);
  contact.add_stiffness(stiffness);
  REQUIRE(stiffness.factorise_definite(shift));
  // K u = change, so that (K + shift) has the answer u where it is asked for change + shift u. Along the
  // normal alone: the stiffness leaves out that normals turn.
  CHECK(change[3].z() > 10);
  std::vector<Vec3> answer(6);
  for (std::size_t i = 0; i < 6; ++i) answer[i] = Vec3(0, 0, change[i].z() + shift * up[i].z());
  stiffness.solve(answer);
  for (std::size_t i = 0; i < 6; ++i) CHECK((answer[i] - up[i]).norm() < 1e-4);
}

TEST_CASE("cloth_contact: a move farther than single precision goes is cut as any other", "[long]") {
  const Cloth cloth = two_sheets(0.2, 3);
  const std::vector<Vec3>& x = cloth.particles.x;
  ClothContact contact(cloth, thick, x, {});
  std::vector<Vec3> way(x.size());
  Noise noise(5);
  for (Vec3& w : way) w = noise.vector();
  const auto share = [&](double length) {
    std::vector<Vec3> move = way;
    for (Vec3& m : move) m *= length;
    return contact.safe_share(x, move, 1, nullptr);
  };
  const double metre = share(1);
  CHECK(metre > 0);
  CHECK(metre < 1);
  for (const double length : {1e3, 1e12, 1e37, 1e60}) CHECK(share(length) == Approx(metre / length));
  CHECK(share(1e300) >= 0);
  CHECK(share(1e300) < 1e-299);
  CHECK(share(std::nan("")) >= 0);
}
