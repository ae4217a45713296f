// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/fold/wrinkle.h"

/// What all rules of wrinkle() share.
namespace furrow::geometry {

/// Gives the mesh a whole rest state and notes what it is before the first line.
WrinkleReport begin_wrinkling(Mesh& mesh, const WrinkleOptions& options);

/// Heights of the lines of these widths ([m] by id, NaN: none), from id `first` on, `count` of them; NaN for
/// one whose vertices all went to later lines.
std::vector<double> heights_from(const Mesh& mesh, int first, std::size_t count,
                                 std::span<const double> widths);

/// Stored stiffnesses of hinges know nothing of new lines; where none is stored, gather() sees to it.
void press_stored_hinges(Mesh& mesh, const LineShapes& shapes);

/// Heights of the lines before displacement, after it, and after smoothing.
void note_heights(std::vector<WrinkledLine>& lines, const std::vector<double>& base,
                  const std::vector<double>& drawn, const std::vector<double>& smoothed);

/// Layers over the lines, masses and sums of the finished mesh.
void end_wrinkling(Mesh& mesh, const WrinkleOptions& options, WrinkleReport& report);

}  // namespace furrow::geometry
