// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cmath>

namespace furrow::physics {

/// The angle of a thread to a triangle's edge from corner 0 to corner 1 [rad] once the edges opposite its
/// corners, which had the lengths `from`, have the lengths `to` [m]: the thread runs through the same points
/// of the triangle. Both must span an area.
inline double carried_angle(double angle, const std::array<double, 3>& from,
                            const std::array<double, 3>& to) {
  if (from == to) return angle;
  // Corner 2, with corner 0 in the origin and corner 1 on the x axis.
  const auto apex = [](const std::array<double, 3>& l) {
    const double x = (l[2] * l[2] + (l[1] - l[0]) * (l[1] + l[0])) / (2 * l[2]);
    return std::array<double, 2>{x, std::sqrt((l[1] - x) * (l[1] + x))};
  };
  const auto [x, y] = apex(from);
  const auto [new_x, new_y] = apex(to);
  const double second = std::sin(angle) / y, first = (std::cos(angle) - second * x) / from[2];
  return std::atan2(second * new_y, first * to[2] + second * new_x);
}

}  // namespace furrow::physics
