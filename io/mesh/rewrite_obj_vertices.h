// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <string>
#include <string_view>

#include "io/mesh/mesh_file.h"

namespace furrow::io {

/// An OBJ file's text with other positions: the three coordinates of its i-th `v` line become those of
/// positions[i] [m, y up], in the file's unit and axes as `options` tells them. All else keeps its bytes:
/// polygons, groups, materials, comments, further numbers of a `v` line, line ends, and coordinates whose
/// value stays. But where a vertex moved, normals are made anew, one for each vertex and normal that corners
/// name together, by the area of these corners' faces; those of faces that stay where they were keep their
/// numbers. Positions beyond the file's vertices are passed over (readers append such where a surface is
/// not manifold). A `mtllib` of the folder `there` is named from `here` where both are given. Throws
/// geometry::ContentError, naming `name`, if the file has more vertices than there are positions or a `v`
/// line has no three numbers. O(bytes).
std::string rewrite_obj_vertices(std::string_view text, const std::string& name,
                                 std::span<const geometry::Point> positions, const WriteOptions& options = {},
                                 const std::filesystem::path& there = {},
                                 const std::filesystem::path& here = {});

}  // namespace furrow::io
