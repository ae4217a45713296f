// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/checker_texture.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "io/picture/stroke_font.h"

namespace furrow::io {
namespace {

Colour colour_at(double u, double v, bool light) {
  const auto tint = [&](double x) { return float((light ? 0.80 : 0.50) + 0.20 * x); };
  return {tint(u), tint(0.6 * (1 - u) + 0.2 * v), tint(v)};
}

}  // namespace

Image checker_texture(int size, int squares) {
  if (size < 64 || size > 8192 || squares < 1 || squares > 26 || size < 16 * squares)
    throw std::invalid_argument("checker_texture: " + std::to_string(size) + " pixels, " +
                                std::to_string(squares) +
                                " squares: sizes from 64 to 8192, squares from 1 to 26 of 16 pixels or more");
  Image image{size, size, std::vector<std::uint8_t>(std::size_t{3} * size * size)};
  const double side = double(size) / squares;
  std::uint8_t* pixel = image.rgb.data();
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      const double x = (column + 0.5) / side, y = (size - row - 0.5) / side;
      const bool light = (int(x) + int(y)) % 2 == 0;
      const double from_cross = std::min(std::abs(x - int(x) - 0.5), std::abs(y - int(y) - 0.5)) * side;
      const Colour c = colour_at(x / squares, y / squares, light);
      for (float channel : c)
        *pixel++ = std::uint8_t(std::lround(255 * channel * (from_cross < 0.012 * side ? 0.8 : 1)));
    }
  }
  for (int i = 0; i < squares; ++i) {
    for (int j = 0; j < squares; ++j) {
      const std::string label = char('A' + i) + std::to_string(j + 1);
      const double height = 0.30 * side, left = (i + 0.5) * side - text_width(label, height) / 2;
      draw_text(image, label, left, size - (j + 0.5) * side + height / 2, height, {0.1f, 0.1f, 0.12f});
    }
  }
  return image;
}

}  // namespace furrow::io
