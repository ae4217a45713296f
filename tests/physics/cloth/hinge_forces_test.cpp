// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/cloth/hinge_forces.h"

#include <catch2/catch.hpp>
#include <numbers>

#include "tests/physics/cloth/finite_differences.h"
#include "tests/physics/cloth/shell_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

constexpr double pi = std::numbers::pi;

/// Two flaps over the edge from (0, 0, 0) to (0.2, 0, 0), seen from +z, bent to the angle theta.
Cloth book(double theta, HingeLaw law = HingeLaw::linear, double rest_angle = 0, double stiffness = 0.7) {
  Cloth cloth;
  const double c = std::cos(theta / 2), s = std::sin(theta / 2);
  add_particle(cloth, {0, 0, 0}, 1);
  add_particle(cloth, {0.2, 0, 0}, 1);
  add_particle(cloth, {0.05, 0.1 * c, -0.1 * s}, 1);
  add_particle(cloth, {0.11, -0.15 * c, -0.15 * s}, 1);
  cloth.hinges.push_back({{0, 1, 2, 3}, rest_angle, stiffness});
  cloth.hinge_law = law;
  return cloth;
}

double angle_of(const Cloth& cloth) {
  const auto& x = cloth.particles.x;
  return dihedral_angle(x[0], x[1], x[2], x[3]);
}

Cloth crumpled(int seed, HingeLaw law) {
  Cloth cloth = without_springs(sheet(4, 4, 0.1, 0.2, seed));
  add_hinges(cloth, 1e-3);
  cloth.hinge_law = law;
  Noise noise(seed);
  for (Hinge& h : cloth.hinges) h.rest_angle = 0.8 * noise();
  for (Vec3& x : cloth.particles.x) x += 0.03 * noise.vector();
  return cloth;
}

}  // namespace

TEST_CASE("dihedral: an angle is signed, ridges count positive") {
  for (const double theta : {-3.1, -2.0, -0.5, -1e-9, 0.0, 1e-9, 0.3, 1.7, 3.1})
    CHECK(angle_of(book(theta)) == Approx(theta).epsilon(1e-12).margin(1e-16));
  const auto x = book(0.3).particles.x;
  CHECK(dihedral_angle(x[1], x[0], x[3], x[2]) == Approx(0.3).epsilon(1e-14));  // the same hinge, turned
  CHECK(dihedral_angle(x[0], x[1], x[0], x[3]) == 0);                           // no flap
}

TEST_CASE("hinges: derivatives agree with finite differences at random configurations") {
  const HingeLaw law = GENERATE(HingeLaw::linear, HingeLaw::cosine);
  for (int seed = 1; seed <= 6; ++seed) {
    const Cloth cloth = crumpled(seed, law);
    const DerivativeErrors errors = derivative_errors(cloth, cloth.particles.x, 2e-5);
    CAPTURE(seed, errors.force, errors.stiffness, errors.symmetry);
    CHECK(errors.force < 1e-7);
    CHECK(errors.stiffness < 1e-7);
    CHECK(errors.symmetry < 1e-13);
    const Eigen::MatrixXd part = stiffness_matrix(cloth, cloth.particles.x, Stiffness::positive_part);
    CHECK(least_eigenvalue(part) > -1e-12 * part.norm());
  }
}

TEST_CASE("hinges: no total force or moment, and rigid motions change nothing") {
  const Cloth cloth = crumpled(3, GENERATE(HingeLaw::linear, HingeLaw::cosine));
  const Positions& x = cloth.particles.x;
  const Eigen::VectorXd force = forces(cloth, x);
  Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum += force.segment<3>(3 * i);
    moment += x[i].cross(Vec3(force.segment<3>(3 * i)));
  }
  CHECK(sum.norm() < 1e-12 * force.norm());
  CHECK(moment.norm() < 1e-12 * force.norm());
  const Eigen::AngleAxisd turn(2.1, Vec3(1, -2, 1).normalized());
  Positions turned = x;
  for (Vec3& p : turned) p = turn * p + Vec3(1, 1, -2);
  CHECK(potential_energy(cloth, turned) == Approx(potential_energy(cloth, x)).epsilon(1e-11));
}

TEST_CASE("hinge_forces: tips are pushed along the flaps' normals with moment over distance, back to rest") {
  // Paper 2: F = N/d, N = c (cos theta - 1); the linear law has N = -k theta.
  for (const double theta : {-2.5, -1.0, -0.1, 0.1, 1.0, 2.5}) {
    for (const HingeLaw law : {HingeLaw::linear, HingeLaw::cosine}) {
      const Cloth cloth = book(theta, law);
      const auto& x = cloth.particles.x;
      const Eigen::VectorXd force = forces(cloth, x);
      const double moment =
          law == HingeLaw::linear ? 0.7 * theta : std::copysign(0.7 * (1 - std::cos(theta)), theta);
      const Vec3 a = (x[1] - x[0]).cross(x[2] - x[0]).normalized(),
                 b = (x[0] - x[1]).cross(x[3] - x[1]).normalized();
      CHECK((force.segment<3>(6) - moment / 0.1 * a).norm() < 1e-12);
      CHECK((force.segment<3>(9) - moment / 0.15 * b).norm() < 1e-12);
      CHECK(force[8] * theta > 0);  // a ridge's tips hang down and are lifted, a valley's are lowered
      const double energy = law == HingeLaw::linear ? 0.35 * theta * theta
                                                    : 0.7 * (std::abs(theta) - std::sin(std::abs(theta)));
      CHECK(potential_energy(cloth, x) == Approx(energy).epsilon(1e-12));
    }
  }
}

TEST_CASE("hinge_forces: the cosine hinge has no stiffness about rest, and its energy no cancellation") {
  CHECK(hinge_moment(HingeLaw::cosine, 2, 0).curvature == 0);
  CHECK(hinge_moment(HingeLaw::cosine, 2, 1e-6).moment == Approx(1e-12).epsilon(1e-10));
  CHECK(hinge_moment(HingeLaw::cosine, 2, -1e-6).moment == Approx(-1e-12).epsilon(1e-10));
  CHECK(hinge_moment(HingeLaw::cosine, 6, 1e-6).energy == Approx(1e-18).epsilon(1e-10));
  CHECK(hinge_moment(HingeLaw::cosine, 1, 0.1 + 1e-12).energy ==
        Approx(hinge_moment(HingeLaw::cosine, 1, 0.1 - 1e-12).energy).epsilon(1e-10));
}

TEST_CASE("hinge_forces: a moment jumps opposite the rest angle only") {
  const HingeLaw law = GENERATE(HingeLaw::linear, HingeLaw::cosine);
  const auto moment = [&](double theta, double rest) {
    return hinge_moment(law, 1, bend(angle_of(book(theta)), rest)).moment;
  };
  const double e = 1e-7;
  CHECK(moment(pi - e, 2) == Approx(moment(-pi + e, 2)).epsilon(1e-5));
  CHECK(moment(pi - e, -0.5) == Approx(moment(-pi + e, -0.5)).epsilon(1e-5));
  CHECK(moment(2 - pi + e, 2) * moment(2 - pi - e, 2) < 0);
  CHECK(moment(pi - e, 0) * moment(-pi + e, 0) < 0);
  for (const double rest : {-3.0, -1.0, 0.5, 3.1}) CHECK(moment(rest, rest) == Approx(0).margin(1e-12));
}

TEST_CASE("hinge_forces: a cylinder of hinges has the bending energy of a plate") {
  // Isometric: 1/2 B kappa^2 an area. Equilateral triangles with an edge along the axis are right in the
  // mean.
  const double rigidity = 2e-3, radius = 5, edge = 0.1;
  Cloth cloth = without_springs(sheet(24, 24, edge));
  add_hinges(cloth, rigidity);
  Positions x = cloth.particles.x;
  for (Vec3& p : x) p = Vec3(p.x(), radius * std::sin(p.y() / radius), radius * std::cos(p.y() / radius));
  const double area = double(cloth.triangles.size()) * std::sqrt(3) / 4 * edge * edge,
               plate = 0.5 * rigidity / (radius * radius) * area;
  CHECK(potential_energy(cloth, x) == Approx(plate).epsilon(0.08));
}

TEST_CASE("hinges: what is out of range is refused") {
  CHECK(hinge_stiffness(0.5, 0.2, 0.01, 0.03, 2) == Approx(1).epsilon(1e-14));
  CHECK_THROWS_AS(hinge_stiffness(-1, 1, 1, 1), std::invalid_argument);
  CHECK_THROWS_AS(hinge_stiffness(1, 0, 1, 1), std::invalid_argument);
  CHECK_THROWS_AS(hinge_stiffness(1, 1, 0, 0), std::invalid_argument);
  const auto refused = [](auto change) {
    Cloth cloth = book(0.3);
    change(cloth.hinges[0]);
    CHECK_THROWS_AS(potential_energy(cloth, cloth.particles.x), std::invalid_argument);
  };
  refused([](Hinge& h) { h.vertices[2] = 4; });
  refused([](Hinge& h) { h.vertices[2] = 1; });
  refused([](Hinge& h) { h.rest_angle = 4; });
  refused([](Hinge& h) { h.stiffness = -1; });
}
