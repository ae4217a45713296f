// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/blue_noise.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

namespace furrow::tests {
namespace {

TEST_CASE("blue_noise: each of 4096 numbers stands once in a tile of 64, which repeats") {
  std::vector<int> count(4096, 0);
  for (int row = 0; row < 64; ++row)
    for (int column = 0; column < 64; ++column) {
      const double x = io::blue_noise(column, row) * 4096;
      REQUIRE(x == std::floor(x));
      ++count.at(std::size_t(x));
      CHECK(io::blue_noise(column + 64, row + 640) == io::blue_noise(column, row));
    }
  for (int c : count) CHECK(c == 1);
}

TEST_CASE("blue_noise: means over small squares hardly differ, where white noise would show grain") {
  for (const int side : {2, 4, 8}) {
    double sum2 = 0;
    int squares = 0;
    for (int row = 0; row < 64; row += side)
      for (int column = 0; column < 64; column += side, ++squares) {
        double mean = 0;
        for (int j = 0; j < side; ++j)
          for (int i = 0; i < side; ++i) mean += io::blue_noise(column + i, row + j) / (side * side);
        sum2 += (mean - 0.5) * (mean - 0.5);
      }
    const double white = 1 / (12.0 * side * side);  // the variance of such a mean of white noise
    CHECK(sum2 / squares < (side == 2 ? 0.5 : 0.2) * white);
  }
}

}  // namespace
}  // namespace furrow::tests
