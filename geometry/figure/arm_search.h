// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <optional>
#include <span>

#include "geometry/figure/skeleton.h"

namespace furrow::geometry {

/// The arms of a standing body with that trunk, as find_skeleton() says; none where there is none.
std::array<std::optional<Arm>, 2> find_arms(std::span<const Point> points,
                                            std::span<const std::array<int, 3>> triangles,
                                            std::span<const TorsoLevel> levels);

}  // namespace furrow::geometry
