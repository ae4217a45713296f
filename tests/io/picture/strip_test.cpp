// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/strip.h"

#include <catch2/catch.hpp>

#include "tests/io/picture/scenes.h"

namespace furrow::tests {
namespace {

io::Image plain(int width, int height, std::uint8_t value) {
  return {width, height, std::vector<std::uint8_t>(std::size_t(3 * width * height), value)};
}

/// Columns with dark pixels below a row: first and last, −1 where there are none.
std::pair<int, int> ink_below(const io::Image& image, int row, int left, int right) {
  std::pair<int, int> found{-1, -1};
  for (int x = left; x < right; ++x) {
    for (int y = row; y < image.height; ++y) {
      if (pixel(image, x, y)[0] > 128) continue;
      if (found.first < 0) found.first = x;
      found.second = x;
    }
  }
  return found;
}

TEST_CASE("strip: panels stand side by side, the lower one in the middle, on paper") {
  const std::vector<io::Panel> panels{{plain(50, 80, 10), ""}, {plain(30, 40, 90), ""}};
  const io::Image strip = io::strip(panels, {0.05, 6, {1, 1, 1}, {0, 0, 0}});
  CHECK(strip.width == 6 + 50 + 6 + 30 + 6);
  CHECK(strip.height == 80 + 2 * 6);  // no captions: no room for them
  int first = 0, second = 0, white = 0;
  for (int y = 0; y < strip.height; ++y) {
    for (int x = 0; x < strip.width; ++x) {
      const int value = pixel(strip, x, y)[0];
      first += value == 10 && x >= 6 && x < 56 && y >= 6 && y < 86;
      second += value == 90 && x >= 62 && x < 92 && y >= 26 && y < 66;
      white += value == 255;
    }
  }
  CHECK(first == 50 * 80);
  CHECK(second == 30 * 40);
  CHECK(first + second + white == strip.width * strip.height);
}

TEST_CASE("strip: captions stand centred under their panels and inside their widths") {
  const std::vector<io::Panel> panels{
      {plain(200, 200, 255), "smoothed"}, {plain(200, 200, 255), ""}, {plain(200, 200, 255), "one\ntwo"}};
  const io::Image strip = io::strip(panels, {0.06, 10, {1, 1, 1}, {0, 0, 0}});
  CHECK(strip.height > 200 + 2 * 10 + 2 * 12);
  const auto first = ink_below(strip, 210, 0, 215);
  CHECK(first.first > 10);
  CHECK(first.second < 210);
  CHECK(std::abs((first.first + first.second) / 2 - 110) <= 3);
  CHECK(ink_below(strip, 210, 215, 425).first == -1);
  CHECK(ink_below(strip, 210, 425, 640).first > 430);
}

TEST_CASE("strip: a caption that is too long makes the letters smaller, not the strip wider") {
  const std::string text = "a caption that is far too long for a panel of a hundred pixels";
  const io::Image strip = io::strip(std::vector<io::Panel>{{plain(100, 300, 255), text}}, {0.1, 4});
  CHECK(strip.width == 108);
  const auto ink = ink_below(strip, 304, 0, 108);
  CHECK(ink.first >= 4);
  CHECK(ink.second < 104);
  CHECK(ink.second - ink.first > 85);
}

TEST_CASE("strip: a strip of nothing and options out of range are refused") {
  const std::vector<io::Panel> good{{plain(10, 10, 1), "a"}};
  CHECK_THROWS_AS(io::strip({}), std::invalid_argument);
  CHECK_THROWS_WITH(io::strip(std::vector<io::Panel>{good[0], {{2, 2, {1}}, "b"}}),
                    Catch::Contains("panel 1"));
  CHECK_THROWS_WITH(io::strip(good, {0.9, 4}), Catch::Contains("text_height 0.9"));
  CHECK_THROWS_WITH(io::strip(good, {0.1, -1}), Catch::Contains("gap -1"));
  CHECK_THROWS_WITH(io::strip(good, {0.1, 1, {2, 0, 0}}), Catch::Contains("colour"));
}

}  // namespace
}  // namespace furrow::tests
