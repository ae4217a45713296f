// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/cloth/membrane.h"

#include <catch2/catch.hpp>
#include <numeric>

#include "tests/physics/cloth/finite_differences.h"
#include "tests/physics/cloth/shell_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

namespace {

Cloth membrane_sheet(int seed, double jitter = 0.25) {
  Cloth cloth = without_springs(sheet(5, 4, 0.1, jitter, seed));
  add_membrane(cloth, 300, 0.35);
  return cloth;
}

double whole_area(const Cloth& cloth) {
  double sum = 0;
  for (const MembraneTriangle& t : cloth.membrane) sum += membrane_constants(t).area;
  return sum;
}

}  // namespace

TEST_CASE("membrane: derivatives agree with finite differences at random configurations") {
  for (int seed = 1; seed <= 6; ++seed) {
    Cloth cloth = membrane_sheet(seed);
    Noise noise(seed);
    for (Vec3& x : cloth.particles.x) x += 0.03 * noise.vector();
    const DerivativeErrors errors = derivative_errors(cloth, cloth.particles.x, 1e-4);
    CAPTURE(seed, errors.force, errors.stiffness);
    CHECK(errors.force < 1e-8);
    CHECK(errors.stiffness < 1e-8);
    CHECK(errors.symmetry < 1e-14);
    const Eigen::MatrixXd part = stiffness_matrix(cloth, cloth.particles.x, Stiffness::positive_part),
                          exact = stiffness_matrix(cloth, cloth.particles.x, Stiffness::exact);
    CHECK(least_eigenvalue(part) > -1e-12 * part.norm());
    CHECK(least_eigenvalue(part - exact) > -1e-12 * part.norm());
  }
}

TEST_CASE("membrane: an affine map has the energy of the formula, no force on the inside") {
  Cloth cloth = membrane_sheet(3);
  const double area = whole_area(cloth), lambda = cloth.membrane[0].lambda, mu = cloth.membrane[0].mu;
  Noise noise(17);
  for (int round = 0; round < 10; ++round) {
    Mat3 f = Mat3::Identity();
    for (int i = 0; i < 9; ++i) f(i / 3, i % 3) += 0.4 * noise();
    Positions x = cloth.particles.x;
    for (Vec3& p : x) p = f * p;
    const Eigen::Matrix2d e =
        0.5 * (f.leftCols<2>().transpose() * f.leftCols<2>() - Eigen::Matrix2d::Identity());
    const double energy = area * (0.5 * lambda * e.trace() * e.trace() + mu * (e * e).trace());
    CHECK(potential_energy(cloth, x) == Approx(energy).epsilon(1e-12));
    const Eigen::VectorXd force = forces(cloth, x);
    for (const int inside : {6, 7, 8, 11, 12, 13}) {
      CHECK(force.segment<3>(3 * inside).norm() < 1e-12 * force.cwiseAbs().maxCoeff());
    }
  }
}

TEST_CASE("membrane: a pulled strip is as stiff as Young says and narrows as Poisson says") {
  // Linear: plane stress with tension sigma along y stretches by sigma/Y and narrows by nu sigma/Y.
  const double y = 200, nu = 0.3, sigma = 1e-5;
  Cloth cloth = without_springs(sheet(6, 6, 0.1));
  add_membrane(cloth, y, nu);
  Positions x = cloth.particles.x;
  const double strain = sigma / y;
  for (Vec3& p : x) p = Vec3(p.x() * (1 - nu * strain), p.y() * (1 + strain), 0);
  const Eigen::VectorXd force = forces(cloth, x);
  double up = 0, sideways = 0;
  for (int i = 0; i < 6; ++i) up += force[3 * i + 1];
  for (int i = 0; i < 36; i += 6) sideways += std::abs(force[3 * i]);
  // The bottom and top rows carry sigma times the width, as does every row between.
  CHECK(-up == Approx(sigma * 0.5).epsilon(0.11).margin(0));
  CHECK(potential_energy(cloth, x) == Approx(0.5 * sigma * strain * whole_area(cloth)).epsilon(1e-6));
  CHECK(sideways < 1.2 * sigma);
}

TEST_CASE("membrane: no total force or moment, and rigid motions change nothing") {
  Cloth cloth = membrane_sheet(4);
  Noise noise(4);
  for (Vec3& x : cloth.particles.x) x += 0.03 * noise.vector();
  const Positions& x = cloth.particles.x;
  const Eigen::VectorXd force = forces(cloth, x);
  Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum += force.segment<3>(3 * i);
    moment += x[i].cross(Vec3(force.segment<3>(3 * i)));
  }
  CHECK(sum.norm() < 1e-12 * force.norm());
  CHECK(moment.norm() < 1e-12 * force.norm());
  const Eigen::AngleAxisd turn(1.1, Vec3(1, 2, -1).normalized());
  Positions turned = x;
  for (Vec3& p : turned) p = turn * p + Vec3(3, 1, -2);
  CHECK(potential_energy(cloth, turned) == Approx(potential_energy(cloth, x)).epsilon(1e-12));
}

TEST_CASE("membrane: the stiffness of an edge is the second derivative by its length") {
  const MembraneTriangle t{{0, 1, 2}, {0.5, 0.4, 0.3}, 70, 90};
  const MembraneConstants c = membrane_constants(t);
  CHECK(c.area == Approx(0.06).epsilon(1e-14));
  for (int edge = 0; edge < 3; ++edge) {
    const auto energy = [&](double by) {
      Eigen::Vector3d d = Eigen::Vector3d::Zero();
      d[edge] = std::pow(t.rest_lengths[edge] + by, 2) - c.length2[edge];
      return 0.5 * d.dot(c.quadratic * d);
    };
    const double h = 1e-4;
    CHECK(edge_stiffness(c, edge) == Approx((energy(h) + energy(-h)) / (h * h)).epsilon(1e-6));
  }
  // Equilateral with nu = 1/3: the lattice of springs.
  const PlaneLame lame = plane_stress(80, 1.0 / 3);
  CHECK(edge_stiffness(membrane_constants({{0, 1, 2}, {2, 2, 2}, lame.lambda, lame.mu}), 1) ==
        Approx(80 * std::sqrt(3) / 4).epsilon(1e-12));
}

TEST_CASE("membrane: what is out of range is refused") {
  CHECK_THROWS_AS(plane_stress(-1, 0.3), std::invalid_argument);
  CHECK_THROWS_AS(plane_stress(1, 1), std::invalid_argument);
  CHECK_THROWS_AS(membrane_constants({{0, 1, 2}, {1, 1, 2}, 1, 1}), std::invalid_argument);
  CHECK_THROWS_AS(membrane_constants({{0, 1, 2}, {1, 1, 0}, 1, 1}), std::invalid_argument);
  CHECK_THROWS_AS(membrane_constants({{0, 1, 2}, {1, 1, 1}, 1, -1}), std::invalid_argument);
  CHECK_THROWS_AS(membrane_constants({{0, 1, 2}, {1, 1, 1}, -3, 1}), std::invalid_argument);
  Cloth cloth = membrane_sheet(1);
  cloth.membrane[3].vertices[1] = 99;
  CHECK_THROWS_AS(potential_energy(cloth, cloth.particles.x), std::invalid_argument);
}
