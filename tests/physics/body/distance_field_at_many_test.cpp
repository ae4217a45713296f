// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "physics/body/distance_field.h"

namespace {

using namespace furrow::physics;

TriangleMesh tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

}  // namespace

TEST_CASE("many queries at once give the bits of single ones, inside and outside the cube, in any number") {
  const DistanceField field = DistanceField::build(tetrahedron());
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> coordinate(-2, 3);
  for (std::size_t n : {0, 1, 31, 32, 33, 1000}) {
    std::vector<Vec3> x(n);
    for (Vec3& p : x) p = {coordinate(random), coordinate(random), coordinate(random)};
    std::vector<SignedDistance> result(n);
    field.at_many(x, result);
    for (std::size_t i = 0; i < n; ++i) {
      CHECK(result[i].value == field.at(x[i]).value);
      CHECK(result[i].gradient == field.at(x[i]).gradient);
    }
  }
}

TEST_CASE("many queries refuse a result of another length, and a NaN point gives NaN") {
  const DistanceField field = DistanceField::build(tetrahedron());
  std::vector<Vec3> x(2, Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
  std::vector<SignedDistance> result(1);
  CHECK_THROWS_AS(field.at_many(x, result), std::invalid_argument);
  result.resize(2);
  field.at_many(x, result);
  CHECK(std::isnan(result[0].value));
}
