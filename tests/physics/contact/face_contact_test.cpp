// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/contact/face_contact.h"

#include <catch2/catch.hpp>

#include "tests/physics/body/test_bodies.h"
#include "tests/physics/cloth/finite_differences.h"
#include "tests/physics/cloth/shell_cloths.h"
#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

/// Two triangles of edges some 5 cm long in the plane y = 0, about the origin.
Cloth two_faces() {
  Cloth cloth;
  for (const Vec3& x :
       {Vec3(-0.02, 0, -0.02), Vec3(0.03, 0, -0.025), Vec3(0.025, 0, 0.03), Vec3(-0.03, 0, 0.025)})
    add_particle(cloth, x, 1e-3);
  cloth.triangles = {{0, 2, 1}, {0, 3, 2}};
  return cloth;
}

FaceContact contact_with(const Collider& body, const Cloth& cloth) {
  return FaceContact(body, body, cloth.triangles, {.clearance = 5e-4, .stiffness = 300});
}

}  // namespace

TEST_CASE("face_contact: a ball smaller than a face is found where no vertex and no sample is near it") {
  const Cloth cloth = two_faces();
  Noise noise(4);
  for (int k = 0; k < 50; ++k) {
    const Vec3 middle = 0.008 * noise.vector();
    const Sphere ball(Vec3(middle.x(), -0.0031, middle.z()), 0.003);  // 0.1 mm below, so that it is near
    FaceContact apart = contact_with(ball, cloth);
    CHECK(apart.find(cloth.particles.x, cloth.particles.inv_mass).changed > 0);
    const Sphere higher(Vec3(middle.x(), -0.0028, middle.z()), 0.003);
    FaceContact through = contact_with(higher, cloth);
    CHECK(through.find(cloth.particles.x, cloth.particles.inv_mass).through > 0);
    const Sphere lower(Vec3(middle.x(), -0.0035, middle.z()), 0.003);
    FaceContact clear = contact_with(lower, cloth);
    CHECK(clear.find(cloth.particles.x, cloth.particles.inv_mass).changed == 0);
    CHECK(clear.points() == 0);
  }
}

TEST_CASE(
    "face_contact: forces are derivatives of its energy, and their sum and moment are the body's push") {
  const Sphere ball(Vec3(0.004, -0.0095, 0.003), 0.01);
  const Cloth cloth = two_faces();
  const std::vector<Vec3>& x = cloth.particles.x;
  FaceContact contact = contact_with(ball, cloth);
  REQUIRE(contact.find(x, cloth.particles.inv_mass).changed > 0);
  const auto energy = [&](const std::vector<Vec3>& at) {
    contact.look(at);
    return contact.energy();
  };
  for (const double lift : {0.0, 4e-4, 9e-4}) {  // linear, soft
    std::vector<Vec3> here = x;
    Noise noise(3);
    for (Vec3& v : here) v += lift * Vec3::UnitY() + 2e-5 * noise.vector();
    contact.look(here);
    CHECK(contact.touching() > 0);
    std::vector<Vec3> force(x.size(), Vec3::Zero());
    contact.add_forces(force);
    Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
    for (std::size_t i = 0; i < x.size(); ++i) {
      sum += force[i];
      moment += (here[i] - ball.centre).cross(force[i]);
      for (int k = 0; k < 3; ++k) {
        std::vector<Vec3> there = here, back = here;
        there[i][k] += 1e-7, back[i][k] -= 1e-7;
        CHECK(force[i][k] == Approx(-(energy(there) - energy(back)) / 2e-7).epsilon(1e-5).margin(1e-8));
      }
    }
    CHECK(sum.y() > 0);
    CHECK(moment.norm() < 1e-12 * sum.norm());  // a ball pushes through its centre
  }
}

TEST_CASE(
    "face_contact: stiffness is the derivative of its forces, and no less where corners are not coupled") {
  const Floor floor;  // no curvature, which stiffness leaves out
  Cloth coupled = without_springs(sheet(2, 2, 0.02));
  add_membrane(coupled, 300);
  for (Vec3& x : coupled.particles.x) x = Vec3(x.x(), 1e-5, x.y());
  Cloth alone;
  for (const Vec3& x : coupled.particles.x) add_particle(alone, x, 1e-3);
  alone.triangles = coupled.triangles;
  const std::vector<Vec3>& x = alone.particles.x;
  FaceContact contact = contact_with(floor, alone);
  REQUIRE(contact.find(x, alone.particles.inv_mass).changed > 0);
  const auto force = [&](const std::vector<Vec3>& at) {
    contact.look(at);
    std::vector<Vec3> f(at.size(), Vec3::Zero());
    contact.add_forces(f);
    return stacked(f);
  };
  const Eigen::MatrixXd minus = differences(x, 1e-7, force);
  contact.look(x);
  const double shift = 1e4;
  FreeStiffness with(coupled), diagonal(alone);
  REQUIRE(with.couples(coupled.triangles[0][0], coupled.triangles[0][1]));
  REQUIRE_FALSE(diagonal.couples(alone.triangles[0][0], alone.triangles[0][1]));
  FreeStiffness without(coupled);
  for (FreeStiffness* s : {&with, &without}) s->assemble(coupled, coupled.particles.x, Stiffness::exact);
  diagonal.assemble(alone, x, Stiffness::exact);
  contact.add_stiffness(with);
  contact.add_stiffness(diagonal);
  REQUIRE(with.factorise_definite(shift));
  REQUIRE(without.factorise_definite(shift));
  REQUIRE(diagonal.factorise_definite(shift));
  Noise noise(2);
  for (int k = 0; k < 5; ++k) {
    std::vector<Vec3> u(x.size());
    for (Vec3& v : u) v = noise.vector();
    // (K + C) u = K u + C u: both sides by solving.
    const auto solved = [&](const FreeStiffness& s, const Eigen::VectorXd& b) {
      std::vector<Vec3> r = moved(std::vector<Vec3>(x.size(), Vec3::Zero()), b);
      s.solve(r);
      return stacked(r);
    };
    const Eigen::VectorXd b = stacked(u), y = solved(without, b);  // (K + shift) y = b
    CHECK((solved(with, b - minus * y) - y).norm() < 1e-6 * y.norm());
    const Eigen::VectorXd z = solved(diagonal, b);  // (D + shift) z = b, D no less than C
    CHECK(z.dot(b) - shift * z.squaredNorm() >= -z.dot(minus * z) - 1e-9 * b.squaredNorm());
  }
}

TEST_CASE("face_contact: bad options are refused by name") {
  const Floor floor;
  const Cloth cloth = two_faces();
  CHECK_THROWS_WITH(FaceContact(floor, floor, cloth.triangles, {.clearance = 0}),
                    Catch::Contains("clearance"));
  CHECK_THROWS_WITH(FaceContact(floor, floor, cloth.triangles, {.error = -1}), Catch::Contains("error"));
  CHECK_THROWS_WITH(FaceContact(floor, floor, cloth.triangles, {.stiffness = 0}),
                    Catch::Contains("stiffness"));
}
