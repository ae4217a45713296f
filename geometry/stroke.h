// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "geometry/mesh.h"

namespace furrow::geometry {

/// A line drawn near a surface: a ridge or a valley of the given height.
struct Stroke {
  std::string name;                 ///< for reports; may be empty
  double height = 0.01;             ///< k [m]; > 0 ridge (outward), < 0 valley (inward)
  std::vector<Point> points;        ///< at least one [m]; any spacing
  bool closed = false;              ///< the last point is joined to the first
  std::optional<Vector> direction;  ///< points are projected along this ray; none: to the closest point
  /// Points that are not joined to the one before: the stroke has several parts. Ascending, in [1, size of
  /// points); only for strokes that are not closed.
  std::vector<std::size_t> breaks = {};
};

}  // namespace furrow::geometry
