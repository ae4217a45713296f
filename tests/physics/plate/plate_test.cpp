// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/plate/plate.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "physics/cloth/dihedral.h"
#include "tests/cases/flat_meshes.h"
#include "tests/cases/plates.h"

using namespace furrow::physics;
using namespace furrow::cases;
using Eigen::MatrixXd, Eigen::Vector3d, Eigen::VectorXd;

namespace {

/// K = -d2w/dx2 as (K11, K22, 2 K12): twelve directions of cylinders and two saddles.
std::vector<Vector3d> curvatures() {
  std::vector<Vector3d> all{{1, -1, 0}, {0, 0, 2}};
  for (int i = 0; i < 12; ++i) {
    const double a = i * std::numbers::pi / 12, c = std::cos(a), s = std::sin(a);
    all.emplace_back(c * c, s * s, 2 * c * s);
  }
  return all;
}

/// How the hinges' angles begin to change where a flat sheet is raised to w = -x^T K x / 2.
VectorXd hinge_bends(const Cloth& cloth, const std::vector<Hinge>& hinges, const Vector3d& k) {
  VectorXd q(Eigen::Index(hinges.size()));
  const auto& x = cloth.particles.x;
  for (std::size_t h = 0; h < hinges.size(); ++h) {
    const auto& v = hinges[h].vertices;
    const Dihedral d = dihedral(x[v[0]], x[v[1]], x[v[2]], x[v[3]]);
    const Vec3 middle = 0.5 * (x[v[0]] + x[v[1]]);
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
      const Vec3 p = x[v[i]] - middle;
      sum -= 0.5 * d.gradient[i].z() * (k[0] * p.x() * p.x() + k[1] * p.y() * p.y() + k[2] * p.x() * p.y());
    }
    q[Eigen::Index(h)] = sum;
  }
  return q;
}

double row_energy(const Plate& plate, int t, const VectorXd& q) {
  Vector3d k = Vector3d::Zero();
  for (int e = plate.begin[t]; e < plate.begin[t + 1]; ++e) k += q[plate.hinge[e]] * plate.share[e];
  return 0.5 * k.dot(plate.stiffness[t] * k);
}

double area_of(const Cloth& cloth, int t) {
  const auto& x = cloth.particles.x;
  const auto& v = cloth.triangles[t];
  return 0.5 * (x[v[1]] - x[v[0]]).cross(x[v[2]] - x[v[0]]).norm();
}

struct Range {
  double least = 1e300, most = 0;
  void add(double value) { least = std::min(least, value), most = std::max(most, value); }
};

/// Energy over the right one in the core of a sheet.
Range plate_energies(const Cloth& cloth, const PlateRigidity& rigidity) {
  const std::vector<char> core = core_of(cloth, 3);
  const PlateParts parts = plate_of(cloth, rigidity);
  const Eigen::Matrix3d d = plate_matrix(rigidity, 0);
  Range range;
  for (const Vector3d& k : curvatures()) {
    const VectorXd q = hinge_bends(cloth, parts.plate.hinges, k);
    double sum = 0, right = 0;
    for (int t = 0; t < parts.plate.triangles(); ++t) {
      const int triangle = parts.triangles[t];
      if (!core[triangle]) continue;
      sum += row_energy(parts.plate, t, q);
      right += 0.5 * area_of(cloth, triangle) * k.dot(d * k);
    }
    REQUIRE(right > 0);
    range.add(sum / right);
  }
  return range;
}

/// The same of plain hinges, half of each counting in either triangle, against Poisson's ratio 0.
Range hinge_energies(const Cloth& cloth) {
  const std::vector<char> core = core_of(cloth, 3);
  const PlateParts parts = plate_of(cloth, isotropic_plate(1));
  Range range;
  for (const Vector3d& k : curvatures()) {
    const VectorXd q = hinge_bends(cloth, parts.plate.hinges, k);
    double sum = 0, right = 0;
    for (int t = 0; t < parts.plate.triangles(); ++t) {
      if (!core[parts.triangles[t]]) continue;
      right += 0.5 * area_of(cloth, parts.triangles[t]) * (k[0] * k[0] + k[1] * k[1] + 0.5 * k[2] * k[2]);
      const auto& v = cloth.triangles[parts.triangles[t]];
      for (std::size_t h = 0; h < parts.plate.hinges.size(); ++h) {
        const auto& [a, b, c, d] = parts.plate.hinges[h].vertices;
        const auto has = [&](int p) { return v[0] == p || v[1] == p || v[2] == p; };
        if (has(a) && has(b) && (has(c) || has(d)))
          sum += 0.25 * parts.plate.hinges[h].stiffness * q[Eigen::Index(h)] * q[Eigen::Index(h)];
      }
    }
    range.add(sum / right);
  }
  return range;
}

/// Q over the hinges.
MatrixXd matrix_of(const Plate& plate) {
  MatrixXd q = MatrixXd::Zero(Eigen::Index(plate.hinges.size()), Eigen::Index(plate.hinges.size()));
  for (int t = 0; t < plate.triangles(); ++t)
    for (int e = plate.begin[t]; e < plate.begin[t + 1]; ++e)
      for (int f = plate.begin[t]; f < plate.begin[t + 1]; ++f)
        q(plate.hinge[e], plate.hinge[f]) += plate.share[e].dot(plate.stiffness[t] * plate.share[f]);
  return q;
}

/// Eigenvalues of Q in units of the plain hinges' stiffness, least and largest.
Range plate_spectrum(const Plate& plate) {
  const MatrixXd q = matrix_of(plate);
  VectorXd scale(q.rows());
  for (Eigen::Index h = 0; h < q.rows(); ++h) scale[h] = 1 / std::sqrt(plate.hinges[h].stiffness);
  const VectorXd values = Eigen::SelfAdjointEigenSolver<MatrixXd>(scale.asDiagonal() * q * scale.asDiagonal(),
                                                                  Eigen::EigenvaluesOnly)
                              .eigenvalues();
  return {values.minCoeff(), values.maxCoeff()};
}

bool is_lattice(SheetKind kind) { return kind == SheetKind::one_diagonal || kind == SheetKind::equilateral; }

Cloth cloth_of(std::vector<Vec3> x, std::vector<std::array<int, 3>> triangles) {
  Cloth cloth;
  cloth.particles.v.assign(x.size(), Vec3::Zero());
  cloth.particles.mass.assign(x.size(), 1), cloth.particles.inv_mass.assign(x.size(), 1);
  cloth.particles.x = std::move(x), cloth.triangles = std::move(triangles);
  return cloth;
}

}  // namespace

TEST_CASE("plate: every quadratic surface has its energy, on eight kinds of meshes") {
  for (const SheetKind kind : sheet_kinds) {
    const Cloth cloth = sheet_of(kind, 1, 1, 12);
    const double tolerance = is_lattice(kind) ? 1e-9 : 1e-4;
    for (const PlateRigidity& rigidity :
         {isotropic_plate(1), isotropic_plate(1, 0.3), PlateRigidity{2, 1, 0.3, 0.2}}) {
      const Range range = plate_energies(cloth, rigidity);
      CAPTURE(name_of(kind), range.least - 1, range.most - 1);
      CHECK(std::abs(range.least - 1) < tolerance);
      CHECK(std::abs(range.most - 1) < tolerance);
    }
  }
}

TEST_CASE("plate: plain hinges have not, which tests the test") {
  const Range cut = hinge_energies(sheet_of(SheetKind::one_diagonal, 1, 1, 12));
  CHECK(cut.most == Approx(3).epsilon(1e-9));
  CHECK(cut.least < 0.76);
  for (const SheetKind kind : sheet_kinds) {
    const Range range = hinge_energies(sheet_of(kind, 1, 1, 12));
    CAPTURE(name_of(kind), range.least, range.most);
    CHECK(std::max(1 - range.least, range.most - 1) > 0.05);
  }
}

TEST_CASE("plate: the operator is definite, and about as stiff as the hinges") {
  for (const SheetKind kind : sheet_kinds) {
    const Range range = plate_spectrum(plate_of(sheet_of(kind, 1, 1, 8), isotropic_plate(1)).plate);
    CAPTURE(name_of(kind), range.least, range.most);
    CHECK(range.least > 0.02);
    CHECK(range.most < (kind == SheetKind::lined ? 40 : 8));
  }
}

TEST_CASE("plate: a cloth that is turned with its warp has the same energy") {
  const PlateRigidity rigidity{2, 1, 0.3, 0.2};
  for (const SheetKind kind : {SheetKind::jittered, SheetKind::one_diagonal}) {
    const Cloth cloth = sheet_of(kind, 1, 1, 12);
    const std::vector<char> core = core_of(cloth, 3);
    for (const double angle : {0.4, 1.0, 2.2}) {
      const PlateParts parts = plate_of(cloth, rigidity, angle);
      const Eigen::Matrix3d d = plate_matrix(rigidity, angle);
      const Vector3d k(0.3, -1, 0.8);
      const VectorXd q = hinge_bends(cloth, parts.plate.hinges, k);
      double sum = 0, right = 0;
      for (int t = 0; t < parts.plate.triangles(); ++t) {
        if (!core[parts.triangles[t]]) continue;
        sum += row_energy(parts.plate, t, q),
            right += 0.5 * area_of(cloth, parts.triangles[t]) * k.dot(d * k);
      }
      CHECK(sum == Approx(right).epsilon(1e-4));
    }
  }
}

TEST_CASE("plate: one vertex pushed against an edge spoils neither exactness nor stiffness") {
  for (const double gap : {1e-1, 1e-2, 1e-3, 2e-4}) {
    Cloth cloth = sheet_of(SheetKind::one_diagonal, 1, 1, 10);
    const int middle = 5 * 11 + 5;
    const Vec3 foot = 0.5 * (cloth.particles.x[middle + 1] + cloth.particles.x[middle + 12]);
    const Vec3 way = cloth.particles.x[middle] - foot;
    cloth.particles.x[middle] = foot + gap * 0.1 / way.norm() * way;
    const Range energies = plate_energies(cloth, isotropic_plate(1)),
                stiff = plate_spectrum(plate_of(cloth, isotropic_plate(1)).plate);
    CAPTURE(gap, energies.least - 1, energies.most - 1, stiff.least, stiff.most);
    CHECK(std::abs(energies.least - 1) < 1e-3);
    CHECK(std::abs(energies.most - 1) < 1e-3);
    CHECK(stiff.most < 600);
    CHECK(stiff.least > 0);
  }
}

TEST_CASE("plate: slivers, lonely triangles and cloth that is held stay finite") {
  Cloth cloth = sheet_of(SheetKind::one_diagonal, 1, 1, 6);
  const int middle = 3 * 7 + 3;
  const Vec3 foot = 0.5 * (cloth.particles.x[middle + 1] + cloth.particles.x[middle + 8]);
  cloth.particles.x[middle] = foot + 1e-6 * (cloth.particles.x[middle] - foot);
  const PlateParts sliver = plate_of(cloth, isotropic_plate(1));
  CHECK(sliver.slivers == 1);
  CHECK(sliver.plain.empty());
  CHECK(plate_spectrum(sliver.plate).most < 600);
  cloth.particles.x[middle] = foot;  // without area
  const PlateParts collapsed = plate_of(cloth, isotropic_plate(1));
  CHECK(collapsed.plain.size() == 3);
  CHECK(plate_spectrum(collapsed.plate).most < 600);

  CHECK(
      plate_of(cloth_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}), isotropic_plate(1)).coupled.empty());
  const Cloth two = cloth_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}});
  const MatrixXd q = matrix_of(plate_of(two, isotropic_plate(1)).plate);
  REQUIRE(q.size() == 1);
  CHECK(q(0, 0) > 0.1);
  CHECK(q(0, 0) < 4);
  Cloth held = sheet_of(SheetKind::jittered, 1, 1, 5);
  for (double& w : held.particles.inv_mass) w = 0;
  CHECK(plate_of(held, isotropic_plate(1)).coupled.empty());
}

TEST_CASE("plate: a held triangle leaves the whole angle to its neighbour") {
  Cloth cloth = cloth_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}});
  for (const int i : {0, 1, 2}) cloth.particles.inv_mass[i] = 0;
  const PlateParts parts = plate_of(cloth, isotropic_plate(1));
  REQUIRE(parts.plate.triangles() == 1);
  CHECK(parts.triangles == std::vector<int>{1});
  // k = l / A N(n) theta over the hypotenuse; the legs are free, so of D with nu = 0 only the twist B / 2 is
  // left: A (2 sqrt 2)^2 B / 2.
  CHECK(matrix_of(parts.plate)(0, 0) == Approx(2).epsilon(1e-12));
}

TEST_CASE("plate: an edge of three triangles keeps its hinges plain") {
  Cloth cloth = cloth_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0.5, 0, 1}, {-1, 1, 0}},
                         {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {0, 2, 5}});
  const std::vector<Hinge> hinges{{{0, 1, 2, 3}, 0, 1}, {{0, 1, 4, 3}, 0, 1}, {{0, 2, 5, 1}, 0, 1}};
  const auto lengths = lengths_of(cloth);
  const PlateParts parts =
      make_plate({cloth.triangles, lengths, hinges, cloth.particles.inv_mass}, {isotropic_plate(1)});
  CHECK(parts.plain == std::vector<int>{0, 1});
  CHECK(parts.coupled == std::vector<int>{2});
  const std::vector<char> apart{0, 0, 1};
  CHECK(make_plate({cloth.triangles, lengths, hinges, cloth.particles.inv_mass, apart}, {isotropic_plate(1)})
            .coupled.empty());
}

TEST_CASE("plate: a press makes a fold stiffer by its factor") {
  const Cloth cloth = cloth_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}});
  const auto lengths = lengths_of(cloth);
  const std::vector<Hinge> hinges{{{1, 2, 0, 3}, 0, 1}};
  const auto with = [&](double press) {
    const std::vector<double> presses{press};
    const std::vector<Hinge> turned{{{1, 2, 0, 3}, 0, 1}};
    return matrix_of(make_plate({cloth.triangles, lengths, turned, cloth.particles.inv_mass, {}, presses},
                                {isotropic_plate(1)})
                         .plate)(0, 0);
  };
  CHECK(with(10) == Approx(10 * with(1)).epsilon(1e-12));
}

TEST_CASE("plate: refuses arrays that do not fit") {
  const Cloth cloth = sheet_of(SheetKind::one_diagonal, 1, 1, 2);
  auto lengths = lengths_of(cloth);
  const auto make = [&](std::span<const double> warp = {}) {
    return make_plate({cloth.triangles, lengths, {}, cloth.particles.inv_mass}, {isotropic_plate(1), warp});
  };
  CHECK_NOTHROW(make());
  CHECK_THROWS_WITH(make(std::vector<double>{1}), Catch::Contains("warp"));
  lengths[0][0] = 0;
  CHECK_THROWS_WITH(make(), Catch::Contains("rest length"));
  lengths.pop_back();
  CHECK_THROWS_WITH(make(), Catch::Contains("lengths"));
}
