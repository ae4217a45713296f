// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <span>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace furrow::io {

/// Largest number of corners of a face that is not convex: cutting it takes time that grows with its square.
inline constexpr std::size_t most_concave_corners = 10000;

/// Appends corners - 2 triangles (indices into `corners`, same orientation) that cover a polygon.
/// Three and four corners, and convex polygons: the fan 0-1-2, 0-2-3, … A polygon of more corners whose fan
/// would turn over somewhere: ear clipping in its plane (normal: Newell's), which also ends on self-crossing
/// or flat polygons, then without promise of the shape. Throws geometry::ContentError for a polygon that is
/// not convex and has more than most_concave_corners.
void triangulate_polygon(std::span<const geometry::Point> corners,
                         std::vector<std::array<std::size_t, 3>>& out);

}  // namespace furrow::io
