// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "io/mesh/ply_rows.h"

namespace furrow::io {

/// Which of a PLY file's vertex properties are what, as indices of properties. Groups are whole or empty.
struct PlyVertexColumns {
  std::vector<std::size_t> xyz;      ///< three
  std::vector<std::size_t> rgba;     ///< three or four: red, green, blue, alpha, or their first letters
  std::vector<std::size_t> texture;  ///< two: s and t, u and v, or texture_u and texture_v
  std::vector<std::size_t> rest;     ///< three: rest_x, rest_y, rest_z
  std::optional<std::size_t> line, mass;
  std::vector<std::size_t> others;    ///< numbers that are none of these, nor normals
  std::vector<std::string> not_read;  ///< lists
};

/// A name belongs to a group only if the whole group is there; else it is one of the others. Texture
/// coordinates at the vertices are passed by where the `faces` have their own. `taken` names columns that are
/// read elsewhere.
PlyVertexColumns find_vertex_columns(const PlyElement& vertices, bool faces_have_texture,
                                     const std::vector<std::string>& taken);

}  // namespace furrow::io
