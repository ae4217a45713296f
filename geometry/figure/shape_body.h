// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>

#include "geometry/figure/torso_levels.h"
#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

/// What a tape measure tells of a person [m]. 0: not asked for.
struct BodyMeasures {
  double height = 0, chest = 0, waist = 0, hip = 0;
  bool any() const { return height != 0 || chest != 0 || waist != 0 || hip != 0; }
};

/// A standing body's, at the heights of torso_heights(). Of a closed surface, faces outwards, y up. Throws
/// ContentError where it has no torso, or has another unit or axis. Cost: as torso_levels().
BodyMeasures measure_body(std::span<const Point> points, std::span<const std::array<int, 3>> triangles);

struct ShapeReport {
  BodyMeasures before, reached;  ///< by the tape
  int rounds = 0;
  double farthest = 0;  ///< largest difference of a girth or the height from what was asked for [m]
};

/// Gives a body a person's measurements: it is scaled to the height, and then each horizontal slice is scaled
/// about the middle of the trunk, by factors that run smoothly from hip to waist to chest and end at ankles
/// and neck; arms move aside with the trunk and keep their thickness. What is not asked for keeps its
/// proportion to the height. Repeated until the tape agrees within 1 mm, or 40 times. Faces and maps stay.
/// Throws std::invalid_argument, nothing changed, if nothing is asked for, a height is outside of 0.9 to
/// 2.5 m, or a girth is less than half or more than twice the body's at that height; as measure_body(), too.
/// Cost: repair_body() once, and torso_levels() a round.
///
/// \details Only the shape of slices changes, not their order: shoulders, neck, head and lengths of limbs
/// follow the height alone, and a bust or a belly grows as the slice that it lies in.
ShapeReport shape_body(Mesh& mesh, const BodyMeasures& wanted);

}  // namespace furrow::geometry
