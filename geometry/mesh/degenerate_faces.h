// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "geometry/mesh/mesh.h"

/// The one rule of which triangles count as collapsed.
namespace furrow::geometry {

/// Whether a triangle of that doubled area [m^2] is no proper one: its area is below 1e-12 times the square
/// of its longest side, whose square is `longest_squared` [m^2]; or it has no size, or none that is a number.
inline bool is_degenerate(double doubled_area, double longest_squared) {
  return !(0.5 * doubled_area >= 1e-12 * longest_squared) || longest_squared == 0;
}

/// The same of a face of the present shape, which must be a triangle.
bool is_degenerate(const Mesh& mesh, Face face);

/// All of them, in the order of their indices. O(faces).
std::vector<Face> degenerate_faces(const Mesh& mesh);

/// "face 12 at (0.1, 0.25, 0) m": its index and its centre, for messages.
std::string name_with_place(const Mesh& mesh, Face face);

}  // namespace furrow::geometry
