// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/cases/membrane_laws.h"

#include <catch2/catch.hpp>
#include <numeric>

#include "tests/cases/flat_meshes.h"
#include "tests/physics/cloth/finite_differences.h"

using namespace furrow::physics;
using namespace furrow::tests;
using namespace furrow::cases;

namespace {

const auto all_laws = {MembraneLaw::paper, MembraneLaw::uniform, MembraneLaw::inverse,
                       MembraneLaw::van_gelder};

/// Two triangles (0 1 2), (2 1 3) with edges 3, 4, 5 and 4, 4, 4.
Cloth kite() {
  Cloth cloth;
  for (int i = 0; i < 4; ++i) add_particle(cloth, {double(i), 0, 0}, 1);
  cloth.triangles = {{0, 1, 2}, {2, 1, 3}};
  cloth.structural = {{0, 1, 3, 0}, {0, 2, 5, 0}, {1, 2, 4, 0}, {1, 3, 4, 0}, {2, 3, 4, 0}};
  return cloth;
}

std::vector<double> stiffness_of(const Cloth& cloth) {
  std::vector<double> k;
  for (const Spring& s : cloth.structural) k.push_back(s.stiffness);
  return k;
}

/// One vertex of the lattice with its six neighbours, each neighbour as far as `edge`.
Cloth lattice_star(double edge, double k) {
  Cloth cloth;
  add_particle(cloth, Vec3::Zero(), 1);
  for (int i = 0; i < 6; ++i) {
    const double a = 3.14159265358979323846 / 3 * i;
    add_particle(cloth, edge * Vec3(std::cos(a), std::sin(a), 0), 1);
    cloth.structural.push_back({0, i + 1, edge, k});
  }
  return cloth;
}

}  // namespace

TEST_CASE("membrane_laws: each gives the stiffness of its formula") {
  Cloth cloth = kite();
  const std::vector<double> areas = rest_areas(cloth);
  const double equilateral = 4 * std::sqrt(3);
  CHECK(areas[0] == Approx(6).epsilon(1e-14));
  CHECK(areas[1] == Approx(equilateral).epsilon(1e-14));
  const auto check = [&](MembraneLaw law, const std::vector<double>& expected) {
    set_membrane_stiffness(cloth, law, 100, areas);
    for (int i = 0; i < 5; ++i) CHECK(cloth.structural[i].stiffness == Approx(expected[i]).epsilon(1e-14));
  };
  check(MembraneLaw::paper, {75, 125, 100, 100, 100});  // r_avg = 4
  check(MembraneLaw::uniform, {100, 100, 100, 100, 100});
  check(MembraneLaw::inverse, {400 / 3.0, 80, 100, 100, 100});
  const double rim = 100 * equilateral / 16;
  check(MembraneLaw::van_gelder, {600 / 9.0, 600 / 25.0, 600 / 16.0 + rim, rim, rim});
}

TEST_CASE("membrane_laws: a lattice of springs is a membrane with Young's modulus Y and nu = 1/3") {
  // A star owns half of each of its six springs and the area sqrt(3)/2 r^2.
  const double young = 80, edge = 0.02;
  const Cloth star = lattice_star(edge, lattice_stiffness(young));
  const double area = std::sqrt(0.75) * edge * edge, e = 1e-6;
  const double lambda = young * 3 / 8, mu = young * 3 / 8;  // nu/(1 - nu^2), 1/(2 (1 + nu))
  Noise noise(2);
  for (int round = 0; round < 20; ++round) {
    const double xx = noise(), xy = noise(), yy = noise();
    Positions x = star.particles.x;
    for (Vec3& p : x) p += e * Vec3(xx * p.x() + xy * p.y(), xy * p.x() + yy * p.y(), 0);
    const double trace = xx + yy, square = xx * xx + 2 * xy * xy + yy * yy;
    CHECK(potential_energy(star, x) / 2 ==
          Approx(area * e * e * (0.5 * lambda * trace * trace + mu * square)).epsilon(1e-5));
  }
}

TEST_CASE("membrane_laws: calibrated springs answer a dilation as the membrane does") {
  const double jitter = GENERATE(0.0, 0.2), young = 120, e = 1e-6;
  Cloth cloth = triangular_sheet(0.3, 0.2, 8, 6, 0.1, jitter, 5);
  const std::vector<double> areas = rest_areas(cloth);
  const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
  CHECK(area == Approx(0.06).epsilon(1e-12));
  Positions x = cloth.particles.x;
  for (Vec3& p : x) p *= 1 + e;
  for (const MembraneLaw law : all_laws) {
    set_membrane_stiffness(cloth, law, calibrated_stiffness(cloth, law, young, areas), areas);
    CHECK(potential_energy(cloth, x) == Approx(1.5 * young * e * e * area).epsilon(1e-5));
  }
  // With the rim's springs at half weight k_std would be that of the lattice.
  Cloth large = triangular_sheet(1, 1, 100, 115, 0.1);
  const double k = calibrated_stiffness(large, MembraneLaw::uniform, young, rest_areas(large));
  CHECK(k == Approx(lattice_stiffness(young)).epsilon(0.02));
}

TEST_CASE("membrane_laws: what is out of range is refused and changes nothing") {
  Cloth cloth = kite();
  const std::vector<double> areas = rest_areas(cloth), before = stiffness_of(cloth);
  const auto refuses = [&](MembraneLaw law, double k, const std::vector<double>& a) {
    CHECK_THROWS_AS(set_membrane_stiffness(cloth, law, k, a), std::invalid_argument);
    CHECK_THROWS_AS(calibrated_stiffness(cloth, law, k, a), std::invalid_argument);
  };
  refuses(MembraneLaw::paper, -1, areas);
  refuses(MembraneLaw::paper, std::nan(""), areas);
  refuses(MembraneLaw::uniform, 1, {6});
  refuses(MembraneLaw::van_gelder, 1, {6, 0});
  CHECK_THROWS_AS(lattice_stiffness(-1), std::invalid_argument);
  CHECK_THROWS_AS(calibrated_stiffness(Cloth{}, MembraneLaw::paper, 1, {}), std::invalid_argument);
  Cloth broken = kite();
  std::swap(broken.structural[0], broken.structural[1]);
  CHECK_THROWS_AS(rest_areas(broken), std::invalid_argument);
  broken = kite();
  broken.structural[1].rest_length = 8;
  CHECK_THROWS_AS(rest_areas(broken), std::invalid_argument);
  broken = kite();
  broken.structural.pop_back();
  CHECK_THROWS_AS(set_membrane_stiffness(broken, MembraneLaw::van_gelder, 1, areas), std::invalid_argument);
  broken = kite();
  broken.structural[2].rest_length = 0;
  CHECK_THROWS_AS(set_membrane_stiffness(broken, MembraneLaw::paper, 1, areas), std::invalid_argument);
  CHECK(stiffness_of(cloth) == before);
}
