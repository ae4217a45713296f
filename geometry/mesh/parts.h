// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

/// A piece of a mesh whose faces hang together through edges.
struct Part {
  std::size_t vertices = 0, faces = 0;
  double area = 0;        ///< [m^2]
  Point centre{0, 0, 0};  ///< of its area; without one, of a corner [m]
  Face first{};           ///< of its faces, by index
};

struct Parts {
  std::vector<Part> list;      ///< largest area first; of equal ones the lower first face
  std::vector<int> of_face;    ///< index into the list, by face index; -1: removed
  std::vector<int> of_vertex;  ///< the same by vertex index; -1: no face's
};

/// Divides a mesh of triangles into its parts. O(faces). Throws ContentError for a face that is no triangle.
Parts find_parts(const Mesh& mesh);

}  // namespace furrow::geometry
