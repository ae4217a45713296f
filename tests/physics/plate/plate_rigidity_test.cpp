// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/plate/plate_rigidity.h"

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/cases/plates.h"

using namespace furrow::physics;
using furrow::cases::strip_rigidity;

namespace {

constexpr double half_turn = std::numbers::pi;

/// Of a narrow strip at an angle to the warp: its border is free, so it is 1 / (D^-1)_11 in its own axes.
double strip_by_inverse(const PlateRigidity& p, double angle) {
  return 1 / plate_matrix(p, -angle).inverse()(0, 0);
}

}  // namespace

TEST_CASE("plate_rigidity: strips have the rigidity that their formula says") {
  const PlateRigidity cloth{46.2e-6, 32.2e-6, twist_of_bias(46.2e-6, 32.2e-6, 30.0e-6), 0};
  CHECK(cloth.twist == Approx(12.4e-6).epsilon(5e-3));  // ivory rib knit, ../shared/bending.md
  CHECK(strip_rigidity(cloth, 0) == Approx(46.2e-6));
  CHECK(strip_rigidity(cloth, half_turn / 2) == Approx(32.2e-6));
  CHECK(strip_rigidity(cloth, half_turn / 4) == Approx(30.0e-6));
  for (const PlateRigidity& p : {cloth, PlateRigidity{2, 1, 0.3, 0.4}, isotropic_plate(1.7, 0.3)})
    for (double angle = -1; angle < 4; angle += 0.37)
      CHECK(strip_rigidity(p, angle) == Approx(strip_by_inverse(p, angle)).epsilon(1e-12));
}

TEST_CASE("plate_rigidity: a plate that is the same in all directions has one matrix in all of them") {
  const PlateRigidity p = isotropic_plate(1e-5, 0.3);
  const Eigen::Matrix3d d = plate_matrix(p, 0);
  CHECK(d(0, 0) == Approx(1e-5 / (1 - 0.09)));
  CHECK(d(0, 1) == Approx(0.3 * d(0, 0)));
  for (const double angle : {0.3, 1.1, -2.0})
    CHECK((plate_matrix(p, angle) - d).norm() < 1e-15 * d.norm() * 10);
  CHECK(plate_matrix(isotropic_plate(0), 0.4).norm() == 0);
}

TEST_CASE("plate_rigidity: a turn by a right angle changes warp and weft") {
  const Eigen::Matrix3d d = plate_matrix({3, 1, 0.5, 0}, half_turn / 2);
  CHECK(d(0, 0) == Approx(1));
  CHECK(d(1, 1) == Approx(3));
  CHECK(d(2, 2) == Approx(0.5));
}

TEST_CASE("plate_rigidity: refuses what is no plate") {
  CHECK_THROWS_WITH(plate_matrix({1, 0, 1, 0}, 0), Catch::Contains("weft"));
  CHECK_THROWS_WITH(plate_matrix({1, 1, -1, 0}, 0), Catch::Contains("twist"));
  CHECK_THROWS_WITH(plate_matrix({1, 4, 1, 0.5}, 0), Catch::Contains("poisson"));
  CHECK_THROWS_AS(isotropic_plate(-1), std::invalid_argument);
  CHECK_THROWS_AS(isotropic_plate(1, 1), std::invalid_argument);
  CHECK_THROWS_WITH(twist_of_bias(1, 1, 4), Catch::Contains("bias"));
}
