// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cmath>
#include <numbers>

#include "geometry/figure/horizontal_section.h"

namespace furrow::geometry {

/// Radii of a slice's outline about its middle [m], in directions in the plane (x, z): the farthest of the
/// outline in each.
struct TrunkOutline {
  static constexpr int directions = 96;
  double height = 0;
  std::array<double, 2> centre{};
  std::array<double, directions> radius{};

  /// In a direction [rad].
  double towards(double angle) const {
    const double at = (angle / (2 * std::numbers::pi) + 1) * directions, whole = std::floor(at);
    const std::size_t i = std::size_t(whole) % directions, next = (i + 1) % directions;
    return radius[i] + (at - whole) * (radius[next] - radius[i]);
  }
};

TrunkOutline outline_of(const SectionLoop& loop, double height);

}  // namespace furrow::geometry
