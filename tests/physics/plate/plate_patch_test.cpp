// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/SparseCholesky>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "physics/plate/plate_bending.h"
#include "tests/cases/flat_meshes.h"
#include "tests/cases/modes.h"
#include "tests/cases/plates.h"
#include "tests/physics/cloth/shell_cloths.h"

using namespace furrow::physics;
using namespace furrow::cases;
using Eigen::Vector3d, Eigen::VectorXd;

namespace {

constexpr double straight_angle = std::numbers::pi;

std::vector<Vector3d> tried_curvatures() {
  std::vector<Vector3d> all{{1, -1, 0}, {0, 0, 2}};
  for (int i = 0; i < 12; ++i) {
    const double c = std::cos(i * straight_angle / 12), s = std::sin(i * straight_angle / 12);
    all.emplace_back(c * c, s * s, 2 * c * s);
  }
  return all;
}

struct Freed {
  double moved;   ///< farthest, over K h^2
  double energy;  ///< lost, over that of the imposed surface
};

/// Quadratic surfaces with the outer three rings held and the rest let go, the worst of all.
Freed freed(Cloth cloth, double h) {
  const std::vector<int> ring = rings_from_border(cloth);
  const std::vector<double> inv_mass = cloth.particles.inv_mass;
  for (std::size_t i = 0; i < ring.size(); ++i) cloth.particles.inv_mass[i] = 1;
  const Unknowns all(cloth, {false, false, true});
  const Eigen::SparseMatrix<double> k = stiffness(cloth, cloth.particles.x, all);
  for (std::size_t i = 0; i < ring.size(); ++i) cloth.particles.inv_mass[i] = ring[i] >= 3;
  const Unknowns inner(cloth, {false, false, true});
  REQUIRE(inner.count > 10);
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(
      stiffness(cloth, cloth.particles.x, inner));
  Freed worst{0, 0};
  for (const Vector3d& c : tried_curvatures()) {
    VectorXd w(all.count);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec3 p = cloth.particles.x[i] - Vec3(0.5, 0.5, 0);
      w[all.of[i][2]] = -0.5 * (c[0] * p.x() * p.x() + c[1] * p.y() * p.y() + c[2] * p.x() * p.y());
    }
    const VectorXd force = -(k * w);
    VectorXd load(inner.count);
    for (std::size_t i = 0; i < ring.size(); ++i)
      if (inner.of[i][2] >= 0) load[inner.of[i][2]] = force[all.of[i][2]];
    const VectorXd u = factors.solve(load);
    worst.moved = std::max(worst.moved, u.cwiseAbs().maxCoeff() / (h * h));
    worst.energy = std::max(worst.energy, load.dot(u) / w.dot(k * w));
  }
  return worst;
}

/// A sheet rolled on a cylinder of radius r about an axis at an angle, without strain.
std::vector<Vec3> rolled_up(const std::vector<Vec3>& flat, double r, double angle) {
  std::vector<Vec3> x;
  const Vec3 along(std::cos(angle), std::sin(angle), 0), across(-std::sin(angle), std::cos(angle), 0);
  for (const Vec3& p : flat) {
    const double s = p.dot(along) / r;
    x.push_back(r * std::sin(s) * along + p.dot(across) * across + Vec3(0, 0, r * (std::cos(s) - 1)));
  }
  return x;
}

Cloth bare(SheetKind kind, int n, double size = 1) {
  Cloth cloth = sheet_of(kind, size, size, n, 1);
  cloth.structural.clear();
  return cloth;
}

/// The lowest bending frequency but for the rigid motions, in units of sqrt(B / (density L^4)): inverse
/// iteration beside them.
double lowest_mode(Cloth cloth, bool supported) {
  if (supported) {
    const std::vector<int> ring = rings_from_border(cloth);
    for (std::size_t i = 0; i < ring.size(); ++i)
      if (ring[i] == 0) cloth.particles.inv_mass[i] = 0;
  }
  const Unknowns z(cloth, {false, false, true});
  const Eigen::SparseMatrix<double> k = stiffness(cloth, cloth.particles.x, z);
  const VectorXd m = masses(cloth, z);
  Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(z.count, supported ? 0 : 3);
  VectorXd v(z.count);
  for (std::size_t i = 0; i < z.of.size(); ++i) {
    if (z.of[i][2] < 0) continue;
    const Vec3 p = cloth.particles.x[i] - Vec3(0.5, 0.5, 0);
    if (!supported) rigid.row(z.of[i][2]) << 1, p.x(), p.y();
    v[z.of[i][2]] = 1 + p.x() * p.y();
  }
  Eigen::SparseMatrix<double> shifted = k;
  for (Eigen::Index i = 0; i < m.size(); ++i) shifted.coeffRef(i, i) += 50 * m[i];
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(shifted);
  const Eigen::MatrixXd gram = rigid.transpose() * m.asDiagonal() * rigid;
  for (int i = 0; i < 80; ++i) {
    if (!supported) v -= rigid * gram.ldlt().solve(rigid.transpose() * m.asDiagonal() * v);
    v = factors.solve(VectorXd(m.asDiagonal() * v));
    v.normalize();
  }
  if (!supported) v -= rigid * gram.ldlt().solve(rigid.transpose() * m.asDiagonal() * v);
  return std::sqrt(v.dot(k * v) / v.dot(m.asDiagonal() * v));
}

}  // namespace

TEST_CASE("plate_bending: quadratic surfaces stay where they are when they are let go", "[release]") {
  for (const SheetKind kind : sheet_kinds) {
    Cloth cloth = bare(kind, 12);
    add_plate(cloth, isotropic_plate(1, 0.3));
    const Freed plate = freed(cloth, 1.0 / 12);
    CAPTURE(name_of(kind), plate.moved, plate.energy);
    CHECK(plate.moved < 1e-4);
    CHECK(plate.energy < 1e-4);
  }
}

TEST_CASE("plate_bending: those of plain hinges do not, which tests the test", "[release]") {
  for (const SheetKind kind : {SheetKind::union_jack, SheetKind::jittered, SheetKind::cut_jittered,
                               SheetKind::blue_noise, SheetKind::lined}) {
    Cloth cloth = bare(kind, 12);
    add_flat_hinges(cloth, 1);
    const Freed hinges = freed(cloth, 1.0 / 12);
    CAPTURE(name_of(kind), hinges.moved, hinges.energy);
    CHECK(hinges.energy > 0.02);
    CHECK(hinges.moved > 0.01);
  }
}

TEST_CASE("plate_bending: sheets on cylinders have the energy of their curvature, in every direction",
          "[release]") {
  for (const SheetKind kind : sheet_kinds) {
    for (const PlateRigidity& rigidity : {isotropic_plate(1), PlateRigidity{2, 1, 0.3, 0.2}}) {
      Cloth cloth = bare(kind, 12);
      const std::vector<Vec3> flat = cloth.particles.x;
      PlateParts parts = plate_of(cloth, rigidity);
      const std::vector<char> core = core_of(cloth, 3);
      // Only the core counts: what lies around it has no stiffness.
      double area = 0;
      for (int t = 0; t < parts.plate.triangles(); ++t) {
        const auto& v = cloth.triangles[parts.triangles[t]];
        if (core[parts.triangles[t]])
          area += 0.5 * (flat[v[1]] - flat[v[0]]).cross(flat[v[2]] - flat[v[0]]).norm();
        else
          parts.plate.stiffness[t].setZero();
      }
      const PlateBending bending(parts.plate, flat.size());
      const std::array<std::pair<double, double>, 3> cases{{{5, 6e-3}, {10, 1.5e-3}, {20, 4e-4}}};
      for (const auto& [radius, tolerance] : cases) {
        for (int i = 0; i < 12; ++i) {
          const double r = radius / 12, c = std::cos(i * straight_angle / 12),
                       s = std::sin(i * straight_angle / 12);
          const Vector3d k(c * c / r, s * s / r, 2 * c * s / r);
          const double right = 0.5 * area * k.dot(plate_matrix(rigidity, 0) * k);
          const double energy = bending.energy(rolled_up(flat, r, i * straight_angle / 12));
          CAPTURE(name_of(kind), radius, i, energy / right - 1);
          CHECK(std::abs(energy / right - 1) < tolerance);
        }
      }
    }
  }
}

TEST_CASE("plate_bending: free and supported squares sing as Kirchhoff's, to the second order", "[release]") {
  // Leissa 1973, free square, nu = 0.3: 13.468; supported: 2 pi^2; both in units of sqrt(D), D =
  // B / (1 - nu^2).
  const std::array<std::pair<bool, double>, 2> cases{
      {{false, 13.468}, {true, 2 * straight_angle * straight_angle}}};
  for (const SheetKind kind : {SheetKind::one_diagonal, SheetKind::union_jack, SheetKind::equilateral,
                               SheetKind::jittered, SheetKind::blue_noise}) {
    for (const auto& [supported, value] : cases) {
      std::array<double, 2> error{};
      for (const int i : {0, 1}) {
        Cloth cloth = bare(kind, i ? 32 : 16);
        add_plate(cloth, isotropic_plate(1 - 0.09, 0.3));
        error[std::size_t(i)] = lowest_mode(cloth, supported) / value - 1;
      }
      CAPTURE(name_of(kind), supported, error[0], error[1], error[0] / error[1]);
      CHECK(std::abs(error[1]) < 2.5e-3);
      CHECK(error[0] / error[1] > 3.3);
      CHECK(error[0] / error[1] < 4.7);
    }
  }
}
