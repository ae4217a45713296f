// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/render_slice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace furrow::io {
namespace {

constexpr double margin = 0.1, step_length = 0.01;  // [m]

std::array<double, 3> colour(double d, double pixel) {
  if (std::abs(d) < 1.5 * pixel) return {0, 0, 0};
  const double fade = std::min(1.0, std::abs(d) / 0.25);
  std::array<double, 3> c =
      d < 0 ? std::array<double, 3>{0.25, 0.45, 0.80} : std::array<double, 3>{0.98, 0.75, 0.45};
  for (double& x : c) x += (d < 0 ? -0.2 : 1 - x) * fade * (d < 0 ? 1 : 0.85);
  const double to_line = std::abs(d / step_length - std::round(d / step_length)) * step_length;
  if (to_line < 0.5 * pixel)
    for (double& x : c) x *= 0.75;
  return c;
}

}  // namespace

Image render_slice(const physics::Collider& body, const physics::Vec3& low, const physics::Vec3& high,
                   int width) {
  if (width < 16 || width > 8192)
    throw std::invalid_argument("render_slice: width = " + std::to_string(width));
  if (!((high - low).minCoeff() >= 0)) throw std::invalid_argument("render_slice: the box is empty");
  const double pixel = (high.x() - low.x() + 2 * margin) / width;
  Image image{width, std::clamp(static_cast<int>((high.y() - low.y() + 2 * margin) / pixel), 1, 16384), {}};
  image.rgb.reserve(std::size_t(3) * image.width * image.height);
  const double z = (low.z() + high.z()) / 2;
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column) {
      const physics::Vec3 x(low.x() - margin + (column + 0.5) * pixel,
                            high.y() + margin - (row + 0.5) * pixel, z);
      for (double channel : colour(body.at(x).value, pixel))
        image.rgb.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(channel, 0.0, 1.0))));
    }
  return image;
}

}  // namespace furrow::io
