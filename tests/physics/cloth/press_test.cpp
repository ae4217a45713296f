// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/cloth/press.h"

#include <catch2/catch.hpp>
#include <limits>

#include "tests/physics/cloth/shell_cloths.h"

using namespace furrow::physics;
using namespace furrow::tests;

TEST_CASE("press: hinges whose edge lies in the patch, and no others") {
  Cloth cloth = sheet(5, 5, 0.1);
  add_hinges(cloth, 1e-4);
  const Cloth before = cloth;
  CHECK(press(cloth, std::vector<int>{6, 7, 12, 7}, 10) == 3);  // a triangle
  int changed = 0;
  for (std::size_t i = 0; i < cloth.hinges.size(); ++i) {
    if (cloth.hinges[i].stiffness == before.hinges[i].stiffness) continue;
    CHECK(cloth.hinges[i].stiffness == 10 * before.hinges[i].stiffness);
    CHECK(cloth.hinges[i].rest_angle == before.hinges[i].rest_angle);
    ++changed;
  }
  CHECK(changed == 3);
  CHECK(press(cloth, {}, 10) == 0);
}

TEST_CASE("press: what cannot be is refused and nothing changes") {
  Cloth cloth = sheet(5, 5, 0.1);
  add_hinges(cloth, 1e-4);
  const double k = cloth.hinges[0].stiffness;
  CHECK_THROWS_WITH(press(cloth, std::vector<int>{0, 1}, 0), Catch::Contains("factor = 0"));
  CHECK_THROWS_AS(press(cloth, std::vector<int>{0, 1}, std::numeric_limits<double>::infinity()),
                  std::invalid_argument);
  CHECK_THROWS_WITH(press(cloth, std::vector<int>{0, 1, 25}, 2), Catch::Contains("particle 25"));
  CHECK(cloth.hinges[0].stiffness == k);
}
