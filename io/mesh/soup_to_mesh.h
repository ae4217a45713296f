// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "io/mesh/mesh_file.h"
#include "io/mesh/polygon_soup.h"

namespace furrow::io {

struct SoupMesh {
  geometry::Mesh mesh;
  RepairReport repairs;
  /// The soup's point of each vertex: i for vertex i, but for those added at the end.
  std::vector<std::size_t> origin;
  std::vector<std::size_t> face_origin;  ///< the soup's face of each face
};

/// Makes an oriented manifold of triangles from a soup: vertex i is point i, triangles follow the faces. Maps
/// are set where the soup has them: colours, vertex attributes, texture, rest lengths of triangles, group,
/// material, and e:diagonal where a face of four corners was cut; copies of vertices carry them along. A face
/// that is the back of an earlier one in another material is its lining (attribute::lining). Throws
/// geometry::ContentError ("name:line: …" or "name: face i: …") if a corner's index is out of range, and if
/// no face is left. Cost: O(F log F).
/// \details Faces are cut by triangulate_polygon(). Triangles with a repeated corner, and those with the
/// three vertices of an earlier one (whichever way they wind), are dropped. If the rest is no oriented
/// manifold already, make_manifold() turns faces and appends copies of vertices. Unused points stay as
/// isolated vertices.
/// `chains`: a soup with lines and without a face becomes its points (ReadOptions::chains).
SoupMesh soup_to_mesh(const PolygonSoup& soup, const std::string& name, bool chains = false);

}  // namespace furrow::io
