// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/mesh/mesh_fwd.h"

namespace furrow::geometry {

/// A line drawn near a surface: a ridge or a valley of the given height, and the shape of its fold.
struct Stroke {
  std::string name;                        ///< for reports; may be empty
  double height = 0.01;                    ///< k [m]; > 0 ridge (outward), < 0 valley (inward)
  std::vector<Coordinates<Point>> points;  ///< at least one [m]; any spacing
  bool closed = false;                     ///< the last point is joined to the first
  std::optional<Coordinates<Vector>>
      direction;  ///< points are projected along this ray; none: to the closest point
  /// Points that are not joined to the one before: the stroke has several parts. Ascending, in [1, size of
  /// points); only for strokes that are not closed.
  std::vector<std::size_t> breaks = {};
  /// Of the whole fold, from where it leaves the cloth to where it meets it again, on the cloth as it lies
  /// before it is raised [m]; > 0. None: rule fold chooses one (prepare_strokes.h); with the others the fold
  /// is as wide as the smoothing of two rings of triangles makes it.
  std::optional<double> width = {};
  /// Of the crest [-]; [0, 1]: 0 round, 1 a tent. None: 0 with rule fold, else 0.5 (line_profile()).
  std::optional<double> sharpness = {};
  double press = 1;  ///< factor on the stiffness of the hinges in the line's region [-]; [1, 1e6]
  // What follows shapes folds of rule fold; the other rules take no notice of it.
  /// At each of `points` [m], or empty: `height`, and `width`, everywhere. Where there are heights, `height`
  /// is the one farthest from 0, and where there are widths, `width` is the greatest.
  std::vector<double> heights = {}, widths = {};
  /// Lengths over which the fold rises at its beginning and its end [m]; >= 0. None: 1.5 widths, at most 0.45
  /// of the line, at an end inside the cloth, 0 at one on a border.
  std::optional<std::array<double, 2>> taper = {};
  std::optional<bool> flare = {};  ///< it rises from end to end; none: if just one end lies on a border
  double smooth = 1;               ///< of the line as drawn, in tenths of the width [-]; [0, 10]; 0: none
  double set = 0.5;                ///< how much of the fold's angles becomes rest angle [-]; [0, 1]
  /// A thread runs along it, and draws it in to this share of its length as the cloth comes to rest [-];
  /// [0.1, 1]. The width is then that of one gather, which is two stitches long. None: it has no thread.
  std::optional<double> gather = {};
};

/// Presses [-] and widths [m, NaN: none] of lines by their ids: of the strokes from `first_line` on; of those
/// before it 1, and none.
struct LineShapes {
  std::vector<double> presses, widths;
};
LineShapes line_shapes(std::span<const Stroke> strokes, int first_line);

/// What is wrong with a key of the fold's shape, with its value; empty if nothing is.
std::string shape_fault(const Stroke& stroke);

}  // namespace furrow::geometry
