// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/degenerate_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "geometry/mesh/face_point.h"

namespace furrow::geometry {

bool is_degenerate(const Mesh& mesh, Face face) {
  const auto c = corners_of(mesh, face);
  double longest = 0;
  for (std::size_t i = 0; i < 3; ++i)
    longest = std::max(longest, CGAL::squared_distance(mesh.point(c[i]), mesh.point(c[(i + 1) % 3])));
  return is_degenerate(std::sqrt(area_normal_of(mesh, face).squared_length()), longest);
}

std::vector<Face> degenerate_faces(const Mesh& mesh) {
  std::vector<Face> found;
  for (Face face : mesh.faces())
    if (is_degenerate(mesh, face)) found.push_back(face);
  return found;
}

std::string name_with_place(const Mesh& mesh, Face face) {
  const Point centre = position_of(mesh, {face, {1.0 / 3, 1.0 / 3, 1.0 / 3}});
  char text[128];
  std::snprintf(text, sizeof text, "face %zu at (%.4g, %.4g, %.4g) m", static_cast<std::size_t>(face.idx()),
                centre.x(), centre.y(), centre.z());
  return text;
}

}  // namespace furrow::geometry
