// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <span>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

/// A point of a section: on the edge from vertex a to vertex b, at a + share (b - a).
struct SectionPoint {
  double x = 0, z = 0;  ///< [m]
  int a = 0, b = 0;     ///< a < b
  double share = 0;     ///< in [0, 1]
};

/// One curve in which a horizontal plane cuts a mesh. Around a mesh that winds outwards it runs
/// counter-clockwise seen from above.
struct SectionLoop {
  std::vector<SectionPoint> points;  ///< in order; the first is not repeated at the end of a closed one
  /// The triangle that the piece from points[i] to the next point lies in: as many as points, one fewer if
  /// the curve is open.
  std::vector<int> triangles;
  bool closed = true;
  double length = 0;  ///< [m]
};

/// The curves in which the plane y = `height` cuts triangles, longest first (of equal length, the one that
/// comes first in the order of the triangles). A vertex at that very height counts as above the plane, so
/// that there is a curve through it or none, never half a one. A curve is open where the surface has a
/// border. Throws std::invalid_argument if the height is not finite or a corner is no index of `points`;
/// ContentError if two triangles go through one edge in the same direction (not wound alike, or three of
/// them at an edge). O(triangles).
std::vector<SectionLoop> horizontal_section(std::span<const Point> points,
                                            std::span<const std::array<int, 3>> triangles, double height);

/// What a tape measure around the curve reads: the perimeter of its convex hull in the plane [m]; 0 without
/// points. O(points log points).
double tape_measure(const SectionLoop& loop);

/// The largest distance between two of its points [m]. O(points log points).
double breadth(const SectionLoop& loop);

/// Whether a place in the plane lies inside a closed curve (even-odd rule); false for an open one.
bool encloses(const SectionLoop& loop, double x, double z);

/// Area inside a closed curve [m^2]; > 0 if it runs counter-clockwise seen from above.
double enclosed_area(const SectionLoop& loop);
/// Its centre of area (x, z) [m]; the mean of the points where the area is 0. At least one point.
std::array<double, 2> centre_of(const SectionLoop& loop);

}  // namespace furrow::geometry
