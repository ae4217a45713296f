// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/pairs/box_tree.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/physics/cloth/test_cloths.h"

using namespace furrow::physics;
using furrow::tests::Noise;

TEST_CASE("box_tree: each box that meets another is visited once, in order, for any number of boxes") {
  Noise noise(3);
  for (const int count : {1, 3, 4, 5, 16, 17, 64, 65, 300}) {
    std::vector<LaneBox> boxes;
    for (int i = 0; i < count; ++i) {
      const Float4 a = float_point(noise.vector(), Vec3::Zero()), b = a + splat(0.1f);
      boxes.push_back({a, b});
    }
    std::vector<FourBoxes> fours(rows_of(boxes.size()));
    for (std::size_t i = 0; i < fours.size(); ++i) {
      std::array<LaneBox, 4> four;
      for (std::size_t j = 0; j < 4; ++j) four[j] = 4 * i + j < boxes.size() ? boxes[4 * i + j] : empty_box();
      fours[i] = FourBoxes::of(four);
    }
    BoxTree tree;
    tree.assign(fours);
    for (const LaneBox& box : boxes)
      for (const int from : {0, 2, count / 2}) {
        std::vector<int> found, expected;
        tree.each_meeting(box, from, [&](int i) { found.push_back(i); });
        for (int i = from; i < count; ++i) {
          bool meets = true;
          for (std::size_t k = 0; k < 3; ++k)
            meets = meets && box.low[k] <= boxes[std::size_t(i)].high[k] &&
                    boxes[std::size_t(i)].low[k] <= box.high[k];
          if (meets) expected.push_back(i);
        }
        CHECK(found == expected);
      }
  }
}

TEST_CASE("box_tree: boxes hold their vertices on their way, far from the origin, too") {
  Noise noise(5);
  for (int i = 0; i < 1000; ++i) {
    const double scale = std::pow(10.0, i % 7 - 3);
    std::vector<Vec3> x(3), way(3);
    for (Vec3& p : x) p = scale * noise.vector();
    for (Vec3& w : way) w = 0.3 * scale * noise.vector();
    FloatSweep sweep;
    const Vec3 origin(0.1, 0.2, -0.3);
    sweep.assign(x, way, origin);
    const double reach = 1e-3;
    const LaneBox box = sweep.box(std::array{0, 1, 2}, float(reach));
    for (std::size_t v = 0; v < 3; ++v)
      for (const double s : {0.0, 0.4, 1.0})
        for (std::size_t k = 0; k < 3; ++k) {
          const double p = (x[v] + s * way[v] - origin)[int(k)];
          CHECK(double(box.low[k]) <= p - reach);
          CHECK(double(box.high[k]) >= p + reach);
        }
  }
}
