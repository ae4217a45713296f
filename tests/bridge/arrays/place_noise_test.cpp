// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/arrays/place_noise.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace furrow;
using physics::Vec3;

namespace {

std::vector<Vec3> box(const Vec3& corner) {
  return {corner, corner + Vec3(0.6, 0, 0.1), corner + Vec3(0.2, 0.7, 0.3)};
}

/// A lattice in the box.
std::vector<Vec3> lattice() {
  std::vector<Vec3> places;
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j)
      for (int k = 0; k < 10; ++k) places.emplace_back(0.03 * i, 0.035 * j, 0.03 * k);
  return places;
}

}  // namespace

TEST_CASE("place_noise: its mean is 0, its root mean square 1, and no place is far out") {
  for (const std::uint64_t seed : {0, 1, 77}) {
    const bridge::PlaceNoise noise(box(Vec3::Zero()), seed);
    double sum = 0, squares = 0, most = 0;
    for (const Vec3& x : lattice()) {
      const double value = noise(x);
      sum += value, squares += value * value, most = std::max(most, std::abs(value));
    }
    CHECK(std::abs(sum / 4000) < 0.2);
    CHECK(squares / 4000 == Approx(1).margin(0.2));
    CHECK(most < 5);
  }
}

TEST_CASE("place_noise: it moves with the box, is smooth, and another seed has another field") {
  const Vec3 away(3.25, -1.5, 0.75);
  const bridge::PlaceNoise here(box(Vec3::Zero()), 3), there(box(away), 3), other(box(Vec3::Zero()), 4);
  CHECK(here.diagonal() == Approx(std::sqrt(0.36 + 0.49 + 0.09)));
  double product = 0;
  for (const Vec3& x : lattice()) {
    CHECK(std::abs(here(x) - there(x + away)) < 1e-10);
    // The shortest wave is a fortieth of the diagonal long.
    CHECK(std::abs(here(x + Vec3(1e-5, 0, 0)) - here(x)) < 1e-5 * 5 * 2 * 3.15 * 40 / here.diagonal());
    product += here(x) * other(x) / 4000;
  }
  CHECK(std::abs(product) < 0.2);
}

TEST_CASE("place_noise: a box without extent has none") {
  CHECK(bridge::PlaceNoise({}, 0)(Vec3(1, 2, 3)) == 0);
  CHECK(bridge::PlaceNoise({Vec3(1, 1, 1), Vec3(1, 1, 1)}, 0)(Vec3(1, 2, 3)) == 0);
}
