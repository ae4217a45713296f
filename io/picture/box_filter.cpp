// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/box_filter.h"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "io/picture/prepared_scene.h"

namespace furrow::io {

Image box_filter(const Image& image, int factor) {
  if (factor < 1 || image.width < 1 || image.height < 1 || image.width % factor || image.height % factor)
    throw std::invalid_argument("box_filter: factor " + std::to_string(factor) + " does not divide " +
                                std::to_string(image.width) + " x " + std::to_string(image.height));
  if (image.rgb.size() != std::size_t{3} * std::size_t(image.width) * std::size_t(image.height))
    throw std::invalid_argument("box_filter: the pixels do not match the sides");
  if (factor == 1) return image;
  std::array<double, 256> light;
  for (int i = 0; i < 256; ++i) light[i] = linear_light(i / 255.0);
  Image result{image.width / factor, image.height / factor, {}};
  result.rgb.reserve(image.rgb.size() / std::size_t(factor) / std::size_t(factor));
  for (int row = 0; row < result.height; ++row)
    for (int column = 0; column < result.width; ++column)
      for (int k = 0; k < 3; ++k) {
        double sum = 0;
        for (int j = 0; j < factor; ++j)
          for (int i = 0; i < factor; ++i)
            sum +=
                light[image.rgb[3 * (std::size_t(row * factor + j) * image.width + column * factor + i) + k]];
        result.rgb.push_back(std::uint8_t(std::lround(255 * srgb(sum / (factor * factor)))));
      }
  return result;
}

}  // namespace furrow::io
