// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "geometry/mesh/property_names.h"

namespace furrow::io {

/// A number at each point, by its name in the file: geometry/mesh/vertex_attributes.h.
struct SoupAttribute {
  std::string name;
  std::vector<double> values;  ///< one a point
};

/// Points and polygons as a file gave them: any connectivity, nothing checked but the coordinates.
/// Every reader fills one; soup_to_mesh() makes the mesh.
struct PolygonSoup {
  std::vector<geometry::Point> points;  ///< in the file's order; metres, y up; finite
  std::vector<geometry::Color> colors;  ///< empty, or one a point
  std::vector<SoupAttribute> attributes;
  std::vector<std::size_t> first_corner = {0};  ///< F + 1 numbers: face f has corners [f], …, [f + 1] - 1
  std::vector<std::size_t> corners;             ///< point of each corner, from 0; may be out of range
  std::vector<geometry::TextureCoordinate> textures;         ///< empty, or one a corner
  std::vector<geometry::TextureCoordinate> second_textures;  ///< the same of a second map
  /// Empty, or one a corner: rest length in its face alone of the edge to the next corner [m], NaN = unset.
  std::vector<double> triangle_rest_lengths;
  std::vector<int> groups;              ///< empty, or one a face
  std::vector<int> materials;           ///< empty, or one a face
  std::vector<std::size_t> face_lines;  ///< line of the file of each face, for errors; or empty

  bool has_lines = false;  ///< between its points: lines of an OBJ, struts of a PLY

  std::size_t faces() const { return first_corner.size() - 1; }
  /// Ends the face whose corners were pushed last.
  void close_face() { first_corner.push_back(corners.size()); }
};

}  // namespace furrow::io
