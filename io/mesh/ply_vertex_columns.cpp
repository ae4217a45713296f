// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/ply_vertex_columns.h"

#include <set>

namespace furrow::io {
namespace {

using Names = std::vector<const char*>;

/// The columns of the first of these groups that is whole.
std::vector<std::size_t> find_group(const PlyElement& element, const std::vector<Names>& groups) {
  for (const Names& group : groups) {
    std::vector<std::size_t> columns;
    for (const char* name : group)
      if (const auto column = find_column(element, {name}, PlyKind::number)) columns.push_back(*column);
    if (columns.size() == group.size()) return columns;
  }
  return {};
}

}  // namespace

PlyVertexColumns find_vertex_columns(const PlyElement& vertices, bool faces_have_texture,
                                     const std::vector<std::string>& taken) {
  PlyVertexColumns found;
  std::set<std::string> used(taken.begin(), taken.end());
  const auto group = [&](const std::vector<Names>& groups) {
    std::vector<std::size_t> columns = find_group(vertices, groups);
    for (const std::size_t c : columns) used.insert(vertices.properties[c].name);
    return columns;
  };
  found.xyz = group({{"x", "y", "z"}});
  found.rgba = group(
      {{"red", "green", "blue", "alpha"}, {"red", "green", "blue"}, {"r", "g", "b", "a"}, {"r", "g", "b"}});
  if (!faces_have_texture) found.texture = group({{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}});
  found.rest = group({{"rest_x", "rest_y", "rest_z"}});
  if (const auto line = group({{"line"}}); !line.empty()) found.line = line[0];
  if (const auto mass = group({{"mass"}}); !mass.empty()) found.mass = mass[0];
  group({{"nx", "ny", "nz"}});  // normals are made anew
  for (std::size_t i = 0; i < vertices.properties.size(); ++i) {
    const PlyProperty& p = vertices.properties[i];
    if (p.count_type)
      found.not_read.push_back(p.name);
    else if (used.insert(p.name).second)
      found.others.push_back(i);
  }
  return found;
}

}  // namespace furrow::io
