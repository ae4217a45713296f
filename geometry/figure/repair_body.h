// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

/// What had to be done to a body. Zero where nothing was.
struct BodyReport {
  std::size_t dropped_faces = 0;      ///< with a repeated corner, or twice the same
  std::size_t merged_points = 0;      ///< at exactly the same position as another, or of no face
  std::size_t duplicated_points = 0;  ///< to part edges of three and more faces
  std::size_t reversed_faces = 0;     ///< against the input, in the end
  std::size_t filled_holes = 0;       ///< border cycles
  std::size_t filling_faces = 0;
  std::size_t components = 0;          ///< joined through edges
  std::size_t self_intersections = 0;  ///< count_self_intersections of the result; 1: too many to count
  bool closed = true;                  ///< no border is left
};

/// A body as plain arrays: closed, consistently wound outwards.
struct Body {
  std::vector<Point> points;                  ///< [m]; not in the order of the input
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise from outside
  BodyReport report;
};

/// Makes a mesh ready for a distance field: drops broken faces, merges equal positions, winds neighbours
/// alike, stitches borders, closes every hole (caps become part of the body) and winds each component
/// outwards. Without self-intersections components are nested by CGAL's orient_to_bound_a_volume (a shell
/// inside another is a cavity); with them every component gets a positive volume, and the sign is a matter
/// for winding numbers. Throws ContentError if the mesh has no faces, a position is not finite or a face is
/// no triangle. Cost: O(n log n), and for a hole of m edges up to O(m^2); above 1000 edges a fan around its
/// centroid, O(m). Source: CGAL's Polygon_mesh_processing (polygon soups, hole filling after Liepa 2003).
Body repair_body(const Mesh& mesh);

}  // namespace furrow::geometry
