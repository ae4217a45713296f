// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/rest/stiffness.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/rest/bending_springs.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

TEST_CASE("spring_stiffness: the papers' law, a constant and the law of a thread") {
  CHECK(spring_stiffness(0.02, 0.01, 1000) == 2000);
  CHECK(spring_stiffness(0.02, 0.01, 1000, StiffnessLaw::constant) == 1000);
  CHECK(spring_stiffness(0.02, 0.01, 1000, StiffnessLaw::inverse) == 500);
  CHECK(spring_stiffness(0.01, 0.01, 0) == 0);
}

TEST_CASE(
    "stiffness: a spring cut in two is four times softer by the papers' law, as stiff as before by the "
    "thread's") {
  const auto in_series = [](double k) { return k / 2; };
  const double whole = spring_stiffness(1, 1, 8);
  CHECK(in_series(spring_stiffness(0.5, 1, 8)) == whole / 4);
  CHECK(in_series(spring_stiffness(0.5, 1, 8, StiffnessLaw::inverse)) == whole);
}

TEST_CASE("spring_stiffness: it refuses lengths and constants that are none") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(spring_stiffness(0, 1, 1), std::invalid_argument);
  CHECK_THROWS_AS(spring_stiffness(1, -1, 1), std::invalid_argument);
  CHECK_THROWS_AS(spring_stiffness(1, 1, -1), std::invalid_argument);
  CHECK_THROWS_AS(spring_stiffness(nan, 1, 1), std::invalid_argument);
  CHECK_THROWS_WITH(spring_stiffness(1, 1, nan), Catch::Contains("k_std"));
}

TEST_CASE("stiffness: mean rest lengths, structural and bending") {
  Mesh mesh = single_triangle();
  CHECK(mean_rest_length(mesh) == Approx((2 + std::sqrt(2)) / 3));
  CHECK(mean_bending_rest_length(mesh) == 0);
  ensure_map(mesh, attribute::rest_length)[Edge(0)] = 10;
  CHECK(mean_rest_length(mesh) > 3.5);
  Mesh square = grid(1, 1);
  rebuild_bending_springs(square);
  CHECK(mean_bending_rest_length(square) == Approx(std::sqrt(2)));
  CHECK_THROWS_AS(mean_rest_length(Mesh()), ContentError);
}
