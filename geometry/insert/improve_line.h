// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "geometry/insert/draw_line.h"

namespace furrow::geometry {

/// How far a drawn line lies from the stroke's samples on cloth.
struct LineDeviation {
  double largest = 0;  ///< [m]
  std::vector<ProjectedSample>
      samples;  ///< farther than half the longest rest edge around them, and than h/2
};

/// "Around": of the sample's face and of the faces crossed before and after it, as they were before the line.
LineDeviation deviation_of(const DrawnLine& drawn, const Mesh& before, const EdgeMap<double>& rest_before,
                           const TracedStroke& traced, double mean_edge);

/// Smallest rest angle [rad] of the faces that a stroke crosses and of their edge neighbours.
double smallest_angle_around(const Mesh& mesh, const EdgeMap<double>& rest, const TracedStroke& traced);

/// Puts into `plan` what to do otherwise about the faces with an angle below `least_angle` [rad]: their new
/// vertices go from the clamped place to the incenter, then to a corner; the links between corners alone go
/// round. Vertices of faces with a sample too far away go towards that sample, then to its corner. Returns
/// false if nothing is left to be changed.
bool improve_plan(const DrawnLine& drawn, const LineDeviation& deviation, double least_angle, LinePlan& plan);

}  // namespace furrow::geometry
