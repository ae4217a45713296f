// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/contact/anchored_contact.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/physics/body/test_bodies.h"
#include "tests/physics/cloth/finite_differences.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

TEST_CASE("anchored_contact: forces are derivatives of its energy") {
  const Sphere ball(Vec3::Zero(), 0.1);
  Cloth cloth;
  const Vec3 out = Vec3(0.3, 0.9, 0.2).normalized();
  for (const double depth : {0.0002, 0.0008, 0.002}) add_particle(cloth, (0.1 + 0.003 - depth) * out, 1e-3);
  const Particles& p = cloth.particles;
  AnchoredContact contact(ball, {.friction = 0.4, .gap = 0.003, .stiffness = 200}, p.size());
  contact.look(p.x, p.inv_mass);
  contact.move_anchors();
  CHECK(contact.touching() == 3);
  CHECK(contact.pushed() == std::vector<int>{0, 1, 2});
  const auto energy = [&](const std::vector<Vec3>& x) {
    contact.look(x, p.inv_mass);
    return contact.energy();
  };
  const Vec3 along = out.cross(Vec3::UnitX()).normalized();
  for (const double way : {2e-5, 8e-5, 3e-3}) {  // linear, and beyond what friction bears
    std::vector<Vec3> x = p.x;
    for (Vec3& v : x) v += way * along;
    contact.look(x, p.inv_mass);
    std::vector<Vec3> force(p.size(), Vec3::Zero());
    contact.add_forces(force);
    contact.look(p.x, p.inv_mass);
    std::vector<Vec3> push(p.size(), Vec3::Zero());
    contact.add_forces(push);
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double h = 1e-7;
      for (const Vec3& direction : {out, along, Vec3(Vec3(2, -1, 0.5).normalized())}) {
        std::vector<Vec3> there = x, back = x;
        there[i] += h * direction, back[i] -= h * direction;
        const double slope = (energy(there) - energy(back)) / (2 * h);
        CHECK(force[i].dot(direction) == Approx(-slope).epsilon(1e-5).margin(1e-8));
      }
      // What friction bears is that of the push where the anchors were set.
      const Vec3 n = x[i].normalized();
      const double pull = force[i].dot(out) / n.dot(out) * n.dot(along) - force[i].dot(along);
      CHECK(pull == Approx(0.4 * push[i].dot(out) * std::min(1.0, way / 1e-4)).epsilon(1e-6));
    }
  }
}

TEST_CASE("anchored_contact: stiffness is the derivative of its forces") {
  const Floor floor;  // no curvature, which stiffness leaves out
  Cloth cloth;
  for (const double depth : {0.0002, 0.0008, 0.002})
    add_particle(cloth, (0.003 - depth) * Vec3::UnitY(), 1e-3);
  const Particles& p = cloth.particles;
  AnchoredContact contact(floor, {.friction = 0.4, .gap = 0.003, .stiffness = 200}, p.size());
  contact.look(p.x, p.inv_mass);
  contact.move_anchors();
  const auto force = [&](const std::vector<Vec3>& x) {
    contact.look(x, p.inv_mass);
    std::vector<Vec3> f(p.size(), Vec3::Zero());
    contact.add_forces(f);
    return stacked(f);
  };
  const double shift = 10;
  for (const double way : {3e-5, 8e-5, 5e-4}) {
    std::vector<Vec3> x = p.x;
    for (Vec3& v : x) v += way * Vec3(0.6, 0, -0.8);
    const Eigen::MatrixXd change = differences(x, 1e-6, force);
    contact.look(x, p.inv_mass);
    FreeStiffness stiffness(cloth);
    stiffness.assemble(cloth, x, Stiffness::exact);
    contact.add_stiffness(stiffness);
    REQUIRE(stiffness.factorise_definite(shift));
    for (Eigen::Index c = 0; c < change.cols(); ++c) {
      Eigen::VectorXd b = -change.col(c);
      b[c] += shift;
      std::vector<Vec3> u = moved(std::vector<Vec3>(p.size(), Vec3::Zero()), b);
      stiffness.solve(u);
      CHECK((stacked(u) - Eigen::VectorXd::Unit(b.size(), c)).norm() < 1e-6);
    }
  }
}

TEST_CASE(
    "anchored_contact: with the secant of friction no move lowers the energy by less than it promises") {
  const Floor floor;
  Cloth cloth;
  add_particle(cloth, 0.002 * Vec3::UnitY(), 1e-3);
  const Particles& p = cloth.particles;
  AnchoredContact contact(floor, {.friction = 0.4, .gap = 0.003, .stiffness = 200}, 1);
  contact.look(p.x, p.inv_mass);
  contact.move_anchors();
  const auto energy = [&](const Vec3& x) {
    contact.look(std::vector<Vec3>(1, x), p.inv_mass);
    return contact.energy();
  };
  int too_much = 0;  // without it
  for (const double way : {5e-5, 2e-4, 2e-3}) {
    const Vec3 x = p.x[0] + way * Vec3(0.6, 0, -0.8);
    const double here = energy(x);
    std::vector<Vec3> force(1, Vec3::Zero());
    contact.add_forces(force);
    FreeStiffness none(cloth), secant(cloth);
    for (FreeStiffness* k : {&none, &secant}) k->assemble(cloth, std::vector<Vec3>(1, x), Stiffness::exact);
    contact.add_stiffness(none);
    contact.add_stiffness(secant, SlipStiffness::secant);
    for (int i = 0; i < 200; ++i) {
      const Vec3 d = 4e-3 * std::sin(1.0 + i) * Vec3(std::cos(3.0 * i), 0, std::sin(3.0 * i));
      const auto promised = [&](const FreeStiffness& k) {
        return -force[0].dot(d) + 0.5 * d.dot(k.times(std::vector<Vec3>(1, d))[0]);
      };
      const double change = energy(x + d) - here;
      CHECK(change <= promised(secant) + 1e-15);
      too_much += change > promised(none) + 1e-15;
    }
  }
  CHECK(too_much > 50);
}

TEST_CASE(
    "anchored_contact: between two walls there is room from the next look on, and friction follows it") {
  struct Walls : Collider {  // 4 mm apart
    SignedDistance at(const Vec3& x) const override {
      return x.x() < 0 ? SignedDistance{0.002 + x.x(), Vec3::UnitX()}
                       : SignedDistance{0.002 - x.x(), -Vec3::UnitX()};
    }
  } walls;
  Cloth cloth;
  add_particle(cloth, Vec3(-0.0005, 0, 0), 1e-3);
  const Particles& p = cloth.particles;
  AnchoredContact contact(walls, {.friction = 0.4, .gap = 0.003, .stiffness = 200}, 1);
  contact.look(p.x, p.inv_mass);
  contact.move_anchors();
  CHECK(contact.deepest() == Approx(0.0015));
  const double before = contact.energy();
  CHECK(before > 0);
  const std::vector<Vec3> there{Vec3(0.0008, 0.0005, 0)};
  contact.make_room(p.x, there, p.inv_mass);  // gap: half of the 1.5 mm that it has on this side
  CHECK(contact.energy() == before);
  contact.look(p.x, p.inv_mass);
  CHECK(contact.touching() == 0);
  contact.look(there, p.inv_mass);
  CHECK(contact.energy() > 0);  // friction of the push that was
  contact.look(p.x, p.inv_mass);
  contact.expect(std::vector<Vec3>(1, Vec3::Zero()));
  contact.look(there, p.inv_mass);
  CHECK(contact.energy() == 0);
}

TEST_CASE("anchored_contact: a push without a direction keeps its energy") {
  struct Flat : Collider {
    SignedDistance at(const Vec3&) const override { return {0.001, Vec3::Zero()}; }
  } flat;
  AnchoredContact contact(flat, {.gap = 0.003, .stiffness = 200}, 1);
  const std::vector<Vec3> x{Vec3::Zero()};
  contact.look(x, std::vector<double>{1000});
  CHECK(contact.energy() > 0);
  CHECK(contact.touching() == 0);
}

namespace {

struct CountingFloor : Collider {
  mutable int asked = 0;
  SignedDistance at(const Vec3& x) const override {
    ++asked;
    return {x.y(), Vec3::UnitY()};
  }
};

struct Remembering : AnchoredContact {
  using AnchoredContact::AnchoredContact;
  using AnchoredContact::forget_levels;
};

}  // namespace

TEST_CASE(
    "anchored_contact: what cannot have come into the gap is not asked for until levels are forgotten") {
  const CountingFloor floor;
  Remembering contact(floor, {0.3, 0.01, 1000}, 3);
  std::vector<Vec3> x{{0, 0.009, 0}, {0, 0.1, 0}, {0, 1, 0}};
  const std::vector<double> inv_mass(3, 1);
  const auto asked = [&] {
    const int before = floor.asked;
    contact.look(x, inv_mass);
    return floor.asked - before;
  };
  CHECK(asked() == 3);
  CHECK(asked() == 3);
  contact.forget_levels();
  CHECK(asked() == 3);
  CHECK(asked() == 1);
  x[1].y() = 0.06;  // at 2 m a metre the distance may be 0.02 now, above the gap
  CHECK(asked() == 1);
  x[1].y() = 0.04;
  CHECK(asked() == 2);
  x[1].y() = 0.009;
  CHECK(asked() == 2);
  CHECK(contact.touching() == 2);
  contact.forget_levels();
  CHECK(asked() == 3);
}
