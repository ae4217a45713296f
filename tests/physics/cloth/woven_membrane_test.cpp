// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Sparse>
#include <catch2/catch.hpp>
#include <numbers>

#include "physics/cloth/elements.h"
#include "physics/cloth/membrane.h"
#include "tests/cases/flat_meshes.h"
#include "tests/physics/cloth/finite_differences.h"

using namespace furrow;
using namespace furrow::physics;
using namespace furrow::tests;

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr WovenModuli limp_bias{450, 450, 50, 0}, uneven{1000, 500, 30, 0.2};

/// A sheet in the plane whose warp leads x by `angle`.
void weave(Cloth& cloth, const WovenModuli& moduli, double angle) {
  const WovenSheet sheet = woven_sheet(moduli);
  const auto& x = cloth.particles.x;
  for (const auto& t : cloth.triangles) {
    MembraneTriangle m{t, {}, sheet.lame.lambda, sheet.lame.mu, {}};
    for (int i = 0; i < 3; ++i) m.rest_lengths[i] = (x[t[(i + 2) % 3]] - x[t[(i + 1) % 3]]).norm();
    const Vec3 first = x[t[1]] - x[t[0]];
    m.threads = {angle - std::atan2(first.y(), first.x()), sheet.warp, sheet.weft};
    cloth.membrane.push_back(m);
  }
}

/// Strains (xx, yy, 2 xy) of cloth whose warp leads x by `angle` under a unit pull along x: its compliance
/// turned, written out from the constants of warp and weft.
Eigen::Vector3d pulled(const WovenModuli& m, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  // Stress in warp and weft of a pull along x, then strains there, then turned back to x and y.
  const double s1 = c * c, s2 = s * s, s12 = -c * s;
  const double e1 = s1 / m.warp - m.poisson / m.warp * s2, e2 = s2 / m.weft - m.poisson / m.warp * s1,
               half = s12 / m.shear / 2;
  return {e1 * c * c + e2 * s * s - 2 * half * c * s, e1 * s * s + e2 * c * c + 2 * half * c * s,
          2 * ((e1 - e2) * c * s + half * (c * c - s * s))};
}

/// The pull of a clamped strip 8 times as long as wide over its width and the strain of its middle half
/// [N/m]; linear.
double modulus_of_strip(cases::SheetKind kind, const WovenModuli& moduli, double angle) {
  const double length = 0.8, width = 0.1, strain = 1e-3;
  Cloth cloth = cases::sheet_of(kind, length, width, 64);
  weave(cloth, moduli, angle);
  const auto& x = cloth.particles.x;
  const double left = std::ranges::min_element(x, {}, [](const Vec3& p) { return p.x(); })->x();
  const int n = int(x.size());
  std::vector<int> row(2 * std::size_t(n), -1);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(2 * n);
  int rows = 1;  // the first: how far the right clamp, which is free to, shifts sideways
  for (int i = 0; i < n; ++i) {
    const double from_left = x[i].x() - left;
    if (from_left > length - 1e-9) u[2 * i] = strain * length, row[2 * i + 1] = 0;
    if (from_left < 1e-9 || from_left > length - 1e-9) continue;
    row[2 * i] = rows++, row[2 * i + 1] = rows++;
  }
  std::vector<Eigen::Triplet<double>> inner, whole;
  add_stiffness(cloth, x, Stiffness::exact, [&](int i, int j, const Mat3& block) {
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b) {
        whole.emplace_back(2 * i + a, 2 * j + b, block(a, b));
        if (row[2 * i + a] >= 0 && row[2 * j + b] >= 0)
          inner.emplace_back(row[2 * i + a], row[2 * j + b], block(a, b));
      }
  });
  Eigen::SparseMatrix<double> k(2 * n, 2 * n), kk(rows, rows);
  k.setFromTriplets(whole.begin(), whole.end());
  kk.setFromTriplets(inner.begin(), inner.end());
  const Eigen::VectorXd load = k * u;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(rows);
  for (int i = 0; i < 2 * n; ++i)
    if (row[i] >= 0) right[row[i]] -= load[i];
  const Eigen::VectorXd found = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(kk).solve(right);
  for (int i = 0; i < 2 * n; ++i)
    if (row[i] >= 0) u[i] = found[row[i]];
  const Eigen::VectorXd force = k * u;
  double pull = 0;
  for (int i = 0; i < n; ++i)
    if (row[2 * i] < 0 && u[2 * i] > 0) pull += force[2 * i];
  // As a strip is measured: by the strain of its middle half, which the clamps do not reach.
  std::vector<int> gauge;
  for (int i = 0; i < n; ++i)
    if (std::abs(x[i].x() - left - length / 2) < length / 4) gauge.push_back(i);
  Eigen::MatrixXd places(gauge.size(), 3);
  Eigen::VectorXd moved(gauge.size());
  for (std::size_t g = 0; g < gauge.size(); ++g) {
    places.row(Eigen::Index(g)) << 1, x[gauge[g]].x(), x[gauge[g]].y();
    moved[Eigen::Index(g)] = u[2 * gauge[g]];
  }
  return pull / (width * places.colPivHouseholderQr().solve(moved)[1]);
}

}  // namespace

TEST_CASE("woven_sheet: strips at an angle are as stiff as the contact page says") {
  const auto at = [](const WovenModuli& m, double degrees) { return strip_modulus(m, degrees * degree); };
  CHECK(at(limp_bias, 0) == Approx(450));
  CHECK(at(limp_bias, 15) == Approx(313.04).epsilon(2e-5));
  CHECK(at(limp_bias, 22.5) == Approx(240.00).epsilon(2e-5));
  CHECK(at(limp_bias, 30) == Approx(194.59).epsilon(3e-5));
  CHECK(at(limp_bias, 45) == Approx(163.636).epsilon(3e-6));
  CHECK(at(uneven, 0) == Approx(1000));
  CHECK(at(uneven, 22.5) == Approx(204.578).epsilon(3e-6));
  CHECK(at(uneven, 45) == Approx(111.317).epsilon(5e-6));
  CHECK(at(uneven, 90) == Approx(500));
  const Eigen::Vector3d bias = pulled(limp_bias, 45 * degree), slanted = pulled(limp_bias, 22.5 * degree),
                        other = pulled(uneven, 22.5 * degree);
  CHECK(-bias[1] / bias[0] == Approx(0.63636).epsilon(1e-5));
  CHECK(std::abs(slanted[2] / slanted[0]) == Approx(0.93333).epsilon(1e-5));
  CHECK(std::abs(other[2] / other[0]) == Approx(1.60325).epsilon(1e-5));
}

TEST_CASE("membrane: a woven strip pulled at any angle has free sides, on every mesh") {
  const double pull = 2;  // [N/m]
  for (const cases::SheetKind kind : cases::sheet_kinds)
    for (const WovenModuli& moduli : {limp_bias, uneven})
      for (const double degrees : {0., 15., 22.5, 30., 45., 60., 75., 90., 135.}) {
        Cloth cloth = cases::sheet_of(kind, 0.2, 0.1, 8);
        weave(cloth, moduli, degrees * degree);
        const Eigen::Vector3d e = pull * pulled(moduli, degrees * degree);
        CAPTURE(cases::name_of(kind), moduli.warp, degrees);
        CHECK(e[0] == Approx(pull / strip_modulus(moduli, degrees * degree)).epsilon(1e-12));
        // Green's strain of a map that keeps x on x: its first column is (a, 0), its second (b, d).
        const double a = std::sqrt(1 + 2 * e[0]), b = e[2] / a, d = std::sqrt(1 + 2 * e[1] - b * b);
        Positions x = cloth.particles.x;
        double least = 1e9, most = -1e9, low = 1e9, high = -1e9;
        for (const Vec3& p : x) {
          least = std::min(least, p.x()), most = std::max(most, p.x());
          low = std::min(low, p.y()), high = std::max(high, p.y());
        }
        std::vector<char> is_end;
        for (Vec3& p : x) {
          is_end.push_back(p.x() < least + 1e-9 ? 1 : p.x() > most - 1e-9 ? 2 : 0);
          p = Vec3(a * p.x() + b * p.y(), d * p.y(), 0);
        }
        std::vector<Vec3> force(x.size(), Vec3::Zero());
        add_forces(cloth, x, force);
        const double scale = pull * (high - low);
        Vec3 right = Vec3::Zero();
        double loose = 0;
        for (std::size_t i = 0; i < x.size(); ++i)
          is_end[i] == 2 ? void(right += force[i])
          : is_end[i]    ? void()
                         : void(loose = std::max(loose, force[i].norm()));
        CHECK(loose < 1e-9 * scale);
        CHECK((right - Vec3(-a * scale, 0, 0)).norm() < 1e-9 * scale);
      }
}

TEST_CASE("membrane: a clamped woven strip pulls as its direction says, on every mesh", "[long]") {
  for (const cases::SheetKind kind : cases::sheet_kinds)
    for (const double degrees : {0., 15., 30., 45., 60., 75., 90.})
      for (const WovenModuli& moduli : {limp_bias, uneven}) {
        const double wanted = strip_modulus(moduli, degrees * degree);
        CAPTURE(cases::name_of(kind), moduli.warp, degrees);
        CHECK(modulus_of_strip(kind, moduli, degrees * degree) == Approx(wanted).epsilon(0.02));
      }
}

TEST_CASE("membrane: threads that add nothing leave a triangle's constants bit for bit") {
  const PlaneLame lame = plane_stress(300, 0.35);
  const MembraneTriangle plain{{0, 1, 2}, {0.5, 0.4, 0.3}, lame.lambda, lame.mu};
  MembraneTriangle turned = plain;
  turned.threads.angle = 0.7;
  CHECK(membrane_constants(plain).quadratic == membrane_constants(turned).quadratic);
  // The same sheet told as warp and weft: equal but for rounding, at any angle.
  const WovenSheet same = woven_sheet({300, 300, 300 / 2.7, 0.35});
  for (const double angle : {0., 0.4, 1.9}) {
    const MembraneTriangle woven{
        {0, 1, 2}, {0.5, 0.4, 0.3}, same.lame.lambda, same.lame.mu, {angle, same.warp, same.weft}};
    const auto& h = membrane_constants(plain).quadratic;
    CHECK((membrane_constants(woven).quadratic - h).norm() < 1e-12 * h.norm());
  }
}

TEST_CASE("membrane: derivatives of woven triangles agree with finite differences") {
  Cloth cloth = cases::sheet_of(cases::SheetKind::jittered, 0.5, 0.3, 5);
  weave(cloth, uneven, 0.6);
  Noise noise(5);
  for (Vec3& x : cloth.particles.x) x += 0.02 * noise.vector();
  const DerivativeErrors errors = derivative_errors(cloth, cloth.particles.x, 1e-4);
  CHECK(errors.force < 1e-8);
  CHECK(errors.stiffness < 1e-8);
  const Eigen::MatrixXd part = stiffness_matrix(cloth, cloth.particles.x, Stiffness::positive_part);
  CHECK(least_eigenvalue(part) > -1e-12 * part.norm());
}

TEST_CASE("woven_sheet: what is no stable sheet is refused") {
  CHECK_THROWS_AS(woven_sheet({0, 1, 1, 0}), std::invalid_argument);
  CHECK_THROWS_AS(woven_sheet({1, 1, 0, 0}), std::invalid_argument);
  CHECK_THROWS_AS(woven_sheet({1, 4, 1, 0.5}), std::invalid_argument);
  CHECK_THROWS_AS(woven_sheet({1, 1, 1, std::nan("")}), std::invalid_argument);
  CHECK_THROWS_AS(membrane_constants({{0, 1, 2}, {1, 1, 1}, 1, 1, {0, -2.7, 0}}), std::invalid_argument);
  CHECK_NOTHROW(membrane_constants({{0, 1, 2}, {1, 1, 1}, 1, 1, {0, -1, 5}}));
}
