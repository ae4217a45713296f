// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/stroke_font.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <set>
#include <string>

#include "tests/io/picture/scenes.h"

namespace furrow::tests {
namespace {

io::Image paper(int width, int height) {
  return {width, height, std::vector<std::uint8_t>(std::size_t(3 * width * height), 255)};
}

TEST_CASE("stroke_font: every printable character has strokes of its own inside the line's height") {
  std::set<std::vector<std::vector<std::array<double, 2>>>> seen;
  for (char c = '!'; c <= '~'; ++c) {
    INFO(c);
    const io::Glyph glyph = io::glyph(c);
    CHECK(glyph.advance > 0);
    CHECK(!glyph.strokes.empty());
    for (const auto& stroke : glyph.strokes) {
      CHECK(stroke.size() >= 2);
      for (const auto& p : stroke) {
        CHECK((p[0] >= 0 && p[0] <= glyph.advance));
        CHECK((p[1] >= -4 && p[1] <= 14));
      }
    }
    if (c != 'l') seen.insert(glyph.strokes);  // I and l look alike
  }
  CHECK(seen.size() == std::size_t('~' - '!'));
  CHECK(io::glyph(' ').strokes.empty());
  CHECK(seen.count(io::glyph('\xe4').strokes) == 0);
  CHECK(io::glyph('\xe4').strokes == io::glyph('\t').strokes);
}

TEST_CASE("stroke_font: text grows with its letters and its height") {
  CHECK(io::text_width("", 20) == 0);
  CHECK(io::text_width("ab", 20) > io::text_width("a", 20));
  CHECK(io::text_width("ab", 40) == Approx(2 * io::text_width("ab", 20)));
}

TEST_CASE("stroke_font: drawn text fills its box and nothing outside") {
  io::Image image = paper(200, 60);
  io::draw_text(image, "HI", 30, 50, 40, {0, 0, 0});
  int left = 200, right = 0, top = 60, bottom = 0;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 200; ++x) {
      if (pixel(image, x, y)[0] > 128) continue;
      left = std::min(left, x), right = std::max(right, x), top = std::min(top, y),
      bottom = std::max(bottom, y);
    }
  }
  CHECK(std::abs(left - 30) <= 3);
  CHECK(std::abs(right - (30 + io::text_width("HI", 40))) <= 3);
  CHECK(std::abs(top - 10) <= 3);
  CHECK(std::abs(bottom - 50) <= 3);
}

TEST_CASE("stroke_font: text outside of the image is cut, an unusable place is refused") {
  io::Image image = paper(20, 20);
  const auto blank = image.rgb;
  io::draw_text(image, "far away", 5000, 10, 10, {0, 0, 0});
  io::draw_text(image, "far away", 0, -1e12, 10, {0, 0, 0});
  CHECK(image.rgb == blank);
  io::draw_text(image, "MMMMMMMM", -30, 15, 10, {0, 0, 0});
  CHECK(image.rgb != blank);
  CHECK_THROWS_AS(io::draw_text(image, "a", 0, 0, 0, {0, 0, 0}), std::invalid_argument);
  CHECK_THROWS_AS(io::draw_text(image, "a", std::numeric_limits<double>::quiet_NaN(), 0, 9, {0, 0, 0}),
                  std::invalid_argument);
}

}  // namespace
}  // namespace furrow::tests
