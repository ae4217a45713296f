// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "geometry/figure/torso_levels.h"
#include "geometry/figure/trunk_outline.h"
#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

/// A section straight across an arm.
struct ArmRing {
  double along = 0;       ///< from the armpit down the arm's axis [m]
  Point centre{0, 0, 0};  ///< [m]
  double radius = 0;      ///< of a circle as long as its tape measure [m]
};

/// An arm, from where it leaves the trunk.
struct Arm {
  Vector axis{0, -1, 0};       ///< of length 1, from the armpit to the wrist
  double length = 0;           ///< from the armpit to the wrist, along the axis [m]
  std::vector<ArmRing> rings;  ///< outwards, from the armpit to the wrist; at least two
};

/// A leg: level slices, upwards from the ankle to the crotch; at least twenty.
struct Leg {
  std::vector<TrunkOutline> slices;
  Vector axis{0, -1, 0};  ///< of length 1, from the crotch to the ankle
};

/// What a standing body has where [m]; y up. Sides: 0 is that of x above the trunk's middle.
struct Skeleton {
  double low = 0, crotch = 0, waist = 0, armpits = 0, shoulders = 0, neck = 0, high = 0;  ///< heights
  std::vector<TrunkOutline> trunk;  ///< level slices, upwards from crotch to armpits
  double shoulder_half = 0;         ///< half of the breadth between the arms' roots
  TrunkOutline neck_slice;
  std::array<std::optional<Arm>, 2> arms;  ///< none: it was not found
  std::array<Leg, 2> legs;
  int faces = 0;  ///< where the feet point: 1 towards +z, -1 towards -z, 0 nobody can say
};

/// Of a closed surface, faces outwards, y up, standing. The trunk is that of torso_levels(). An arm's tip is
/// what lies farthest from the waist on its side, along edges and without going through the legs, so that it
/// may be held in any direction; its sections across are followed inwards until they grow together with the
/// trunk. Legs are level slices. Throws ContentError, which says what is missing, where there is no torso or
/// no two legs. Cost: some 300 sections, and a search for shortest ways.
Skeleton find_skeleton(std::span<const Point> points, std::span<const std::array<int, 3>> triangles);

}  // namespace furrow::geometry
