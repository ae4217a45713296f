// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <string>
#include <vector>

#include "geometry/stroke/fold_curve.h"
#include "geometry/stroke/stroke.h"

namespace furrow::geometry {

struct PrepareOptions {
  double max_distance = 0.05;  ///< as TraceOptions::max_distance [m]; > 0
  double mean_edge = 0;        ///< h: mean rest edge of the garment before its first line [m]; > 0
  int first_line = 0;          ///< id of the first stroke's line
};

struct PreparedStrokes {
  std::vector<FoldCurve> curves;  ///< at least one of each stroke; the pieces of a stroke follow each other
  std::vector<std::string> warnings;
};

/// Makes strokes ready to be folded (rule fold): lays them onto the surface (trace_stroke.h), resamples them
/// to h / 4 and at most width / 20, smooths them as curves (a Gaussian of `smooth` width / 10; ends stay) and
/// lays them back onto it. An end within 0.3 h of a border that it runs towards goes onto it. Warns where
/// smoothing moves a line by more than a tenth of its width, where it bends within half of it, where a fold
/// is steeper than 45 degrees, and where ridge and valley are nearer than a width. Throws as trace_stroke(),
/// and ContentError for a stroke without length and for numbers that are not one a point. \details Width of a
/// stroke that names none: 5 |k|, at most the distance to the nearest line of the same sign where the two run
/// side by side, at least the less of 4 h and 7.5 |k|; of a gathered one without height 40 mm, and at most an
/// eighth of its length. Rise: 1.5 widths and at most 0.45 of the line at an end inside the cloth, 0 at a
/// border; with a flare 0.75 of the line. O(points x faces around), and O(points^2) over pairs of lines.
PreparedStrokes prepare_strokes(const Mesh& mesh, std::span<const Stroke> strokes,
                                const PrepareOptions& options);

}  // namespace furrow::geometry
