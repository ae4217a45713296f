// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>

#include "geometry/quality/fold_surface.h"
#include "geometry/stroke/fold_curve.h"

namespace furrow::geometry {

/// Sections across a fold: a row for each place along its line, w/40 apart; a column for each distance from
/// it. They begin 1.6 w, or 0.3 of the line if that is less, from an end inside the cloth, and at a border.
struct FoldSections {
  double width = 0;                      ///< w: the greatest of the line [m]
  bool closed = false;                   ///< the last row is followed by the first
  std::vector<double> along;             ///< arc length of the rows [m]
  std::vector<double> across;            ///< distance of the columns, left of the line > 0 [m]; |d| <= w/2
  std::vector<Eigen::Vector3d> up;       ///< normal of the feet around the rows
  std::vector<double> crest;             ///< height of the highest point, of a valley the lowest [m]; NaN
  std::vector<Eigen::Vector3d> highest;  ///< its foot [m]
  std::vector<double> beside;            ///< its distance from the line, with the sign of a column's [m]
  std::vector<double> heights;           ///< rows x columns [m]; NaN: no cloth there
  std::vector<Eigen::Vector3d> normals;  ///< of the faces there, as along, left, up [-]; rows x columns
  std::size_t at(std::size_t row, std::size_t column) const { return row * across.size() + column; }
};

/// Rows of a fold are planes across its curve, which cut the feet of the cloth's faces; heights are linear on
/// a face, and distances are straight ones from the feet at the curve. The highest point is looked for within
/// w/4 of it. `crest_alone` leaves heights and normals empty. Faces may come in any order. About O(faces near
/// the curve).
FoldSections cut_sections(const FoldSurface& surface, const FoldCurve& curve, bool crest_alone = false);

}  // namespace furrow::geometry
