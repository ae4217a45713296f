// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "geometry/figure/repair_body.h"
#include "geometry/figure/skeleton.h"

namespace furrow::geometry {

/// A garment's places on another body, and what differs between the two.
struct PlacedGarment {
  std::vector<Point> points;  ///< by vertex [m]
  double height_scale = 1;    ///< height of the new body over that of the old one [-]
  /// From the old direction to the new one [rad], >= 0; the side of +x first. None: an arm that one of the
  /// bodies has not.
  std::array<std::optional<double>, 2> arm_turn;
  std::array<double, 2> leg_turn{};
  /// Of the garment's vertices, that go with a limb before it is blended, in [0, 1].
  std::array<double, 2> arm_share{}, leg_share{};
  double mean_move = 0, farthest_move = 0;  ///< [m]
};

/// Where the vertices of a garment that fits the body `from` lie on the body `to`: as a start for draping.
/// Each goes with the trunk, an arm or a leg of find_skeleton(), or between two of them: turned with the
/// limb, as far along as on the old one, and as far off the skin as it was. Left stays left. The garment is
/// not changed: its rest shape is that of its size. Throws std::invalid_argument for a garment without
/// vertices or with a place that is not finite; ContentError for two bodies that face opposite ways, and for
/// a sleeve without an arm.
///
/// \details Which part a vertex goes with is known by what lies nearest on the old body, blended over some 5
/// cm of cloth. Above the armpits breadth and depth are scaled by those of shoulders and neck.
PlacedGarment place_garment(const Mesh& garment, const Skeleton& from, const Skeleton& to);

}  // namespace furrow::geometry
