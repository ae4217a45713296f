// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>

#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

/// Distances of one surface's points from another surface, by area [m].
struct SurfaceDeviation {
  double median = 0, p95 = 0, largest = 0;
  double area = 0;  ///< of the faces that were looked at [m^2]
};

/// Distances from four points of each of these faces (all faces if there are none given) to the closest
/// point of `to`; each point stands for a quarter of its face's area. Throws ContentError if a mesh has no
/// faces or is not of triangles. O(n log n).
SurfaceDeviation surface_deviation(const Mesh& from, const Mesh& to, std::span<const Face> faces = {});

}  // namespace furrow::geometry
