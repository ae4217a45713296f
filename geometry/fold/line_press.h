// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

/// The factor with which the lines of a mesh press the hinge of every edge [-], by edge index: the greatest
/// press of a line in whose region (line_region.h) both ends lie, else 1. `presses` (>= 1) and `widths` ([m],
/// NaN: none) go by line id; what is missing at their ends is 1, and none. Empty where nothing is pressed. So
/// a press stays right when edges are flipped, split and drawn on. Throws std::invalid_argument if a press is
/// not >= 1 and finite, ContentError as rest_lengths(). Cost: that of the pressed regions, O(edges) once.
std::vector<double> presses_of_lines(const Mesh& mesh, const std::vector<double>& presses,
                                     const std::vector<double>& widths);

/// The same, but where e:press is set (press_map.h) it counts alone. Throws also ContentError for one that is
/// not >= 0 and finite.
std::vector<double> hinge_presses(const Mesh& mesh, const std::vector<double>& presses,
                                  const std::vector<double>& widths);

}  // namespace furrow::geometry
