// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <span>
#include <vector>

#include "geometry/stroke/trace_stroke.h"

namespace furrow::geometry {

using StrokeSegment = std::array<Point, 2>;  ///< [m]; its ends may be one point

/// A traced stroke as it lies on the cloth, as segments inside the faces, in no order: from entry to exit of
/// each face that it crosses, and from sample to sample within a face. Other than the line that is drawn
/// along it, it is the same on a coarse mesh as on a fine one. O(faces crossed + samples).
std::vector<StrokeSegment> stroke_path(const TracedStroke& traced);

/// Distance in space from the nearest segment [m]; infinite without any. O(segments).
double distance_to(std::span<const StrokeSegment> path, const Point& p);

}  // namespace furrow::geometry
