// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/fold/touch.h"
#include "io/mesh/mesh_file.h"

namespace furrow::io {

/// Reads touches, done in their order:
///     {"touches": [{"iron": [x, y, z], "radius": 0.08, "strength": 1}, {"pull": [x, y, z], "by": [x, y, z]},
///                  {"steam": [x, y, z]}, {"pinch": [x, y, z], "strength": 0.3}]}
/// Places are in the file's unit and axes, radius and way in metres; a way is turned as places are. A radius
/// is 0.1 m and a strength 1 (of a pinch 0.3) unless the touch has one. Strict: unknown keys, wrong types and
/// numbers out of range are errors. Throws geometry::ContentError with the touch's number and its key, and
/// for a file without touches; std::runtime_error if the file cannot be read.
std::vector<geometry::Touch> read_touches(const std::filesystem::path& path, const ReadOptions& options = {});
/// The same for the text of a file; `name` stands in messages.
std::vector<geometry::Touch> touches_from(std::string_view json, const std::string& name,
                                          const ReadOptions& options = {});

}  // namespace furrow::io
