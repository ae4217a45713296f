// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

/// A line drawn near a surface: a ridge or a valley of the given height, and the shape of its fold.
struct Stroke {
  std::string name;                 ///< for reports; may be empty
  double height = 0.01;             ///< k [m]; > 0 ridge (outward), < 0 valley (inward)
  std::vector<Point> points;        ///< at least one [m]; any spacing
  bool closed = false;              ///< the last point is joined to the first
  std::optional<Vector> direction;  ///< points are projected along this ray; none: to the closest point
  /// Points that are not joined to the one before: the stroke has several parts. Ascending, in [1, size of
  /// points); only for strokes that are not closed.
  std::vector<std::size_t> breaks = {};
  /// Of the whole fold, from where it leaves the cloth to where it meets it again, on the cloth as it lies
  /// before it is raised [m]; > 0. None: as wide as the smoothing of two rings of triangles makes it.
  std::optional<double> width = {};
  double sharpness = 0.5;  ///< of the crest, goes with a width [-]; [0, 1]: see line_profile()
  double press = 1;        ///< factor on the stiffness of the hinges in the line's region [-]; [1, 1e6]
};

/// Presses [-] and widths [m, NaN: none] of lines by their ids: of the strokes from `first_line` on; of those
/// before it 1, and none.
struct LineShapes {
  std::vector<double> presses, widths;
};
LineShapes line_shapes(std::span<const Stroke> strokes, int first_line);

/// What is wrong with width, sharpness or press, with the key and its value; empty if nothing is.
std::string shape_fault(const Stroke& stroke);

}  // namespace furrow::geometry
