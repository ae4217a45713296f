// SPDX-License-Identifier: MIT
#include "physics/pairs/ease_around.h"

#include <catch2/catch.hpp>
#include <stdexcept>

using namespace furrow::physics;

namespace {

/// A strip of triangles: particles 0, 1, 2, … in a zigzag.
std::vector<std::array<int, 3>> strip(int particles) {
  std::vector<std::array<int, 3>> triangles;
  for (int i = 0; i + 2 < particles; ++i) triangles.push_back({i, i + 1, i + 2});
  return triangles;
}

}  // namespace

TEST_CASE("ease_around: a cut shortens the way there, and less and less around it") {
  constexpr int count = 100;
  std::vector<double> kept(count, 1);
  const std::vector<MoveCut> cuts{{50, 0.1}, {50, 0.5}};
  ease_around(cuts, strip(count), kept);
  CHECK(kept[50] == Approx(0.9 * 0.1));
  for (int i = 0; i + 2 < count; ++i) {
    CHECK(kept[i] <= 1);
    CHECK(std::abs(kept[i] - kept[i + 1]) <= 0.05 + 1e-12);
    CHECK(std::abs(kept[i] - kept[i + 2]) <= 0.05 + 1e-12);
  }
  CHECK(kept[0] == 1);
  CHECK(kept[count - 1] == 1);
}

TEST_CASE("ease_around: a second time shortens what is left, and no cut leaves all as it was") {
  std::vector<double> kept(20, 1);
  ease_around({}, strip(20), kept);
  CHECK(kept == std::vector<double>(20, 1));
  const MoveCut cut{4, 0.5};
  ease_around(std::span(&cut, 1), strip(20), kept);
  const double once = kept[4];
  CHECK(once == Approx(0.45));
  ease_around(std::span(&cut, 1), strip(20), kept);
  CHECK(kept[4] == Approx(0.45 * once));
  const MoveCut beyond{20, 0.5};
  CHECK_THROWS_AS(ease_around(std::span(&beyond, 1), strip(20), kept), std::out_of_range);
}
