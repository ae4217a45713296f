// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/pairs/box_grid.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using furrow::tests::Noise;

TEST_CASE("box_grid: each box that meets another is visited once, for any size of the cells") {
  Noise noise(3);
  std::vector<FloatBox> boxes;
  for (int i = 0; i < 300; ++i) {
    const Vec3 a = noise.vector(), b = a + 0.2 * noise.vector();
    boxes.push_back(box_around(std::array{a, b}, Vec3(0.1, 0.2, 0.3), 0.01));
  }
  for (const double cell : {0.03, 0.2, 5.0}) {
    const BoxGrid grid(boxes, cell);
    for (const FloatBox& box : boxes) {
      std::vector<int> found, expected;
      grid.each_meeting(box, [&](int i) { found.push_back(i); });
      for (int i = 0; i < 300; ++i) {
        bool meets = true;
        for (std::size_t k = 0; k < 3; ++k)
          meets = meets && box.low[k] <= boxes[std::size_t(i)].high[k] &&
                  boxes[std::size_t(i)].low[k] <= box.high[k];
        if (meets) expected.push_back(i);
      }
      std::sort(found.begin(), found.end());
      CHECK(found == expected);
    }
  }
  CHECK_THROWS_AS(BoxGrid(boxes, 0), std::invalid_argument);
}
