// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <iosfwd>
#include <vector>

#include "geometry/stroke.h"
#include "io/mesh_file.h"

namespace furrow::io {

/// Reads strokes by the file name's ending.
/// json: {"strokes": [{"height": 0.02, "points": [[x, y, z], …], "name": "…", "closed": false,
/// "direction": [x, y, z]}, …]}, where only points must be there (closed strokes: at least three). Strict:
/// other keys, other types and numbers that are not finite are errors. obj: the polylines (`l` elements,
/// two-point ones chained), all with the default height. Points and directions are turned, and points scaled,
/// by `options`; heights are in metres always. Throws geometry::ContentError with the place in the text, or
/// the stroke's index and key; also if there is no stroke. Throws std::invalid_argument if default_height [m]
/// is not finite.
std::vector<geometry::Stroke> read_strokes(const std::filesystem::path& path, double default_height = 0.01,
                                           const ReadOptions& options = {});

/// Writes strokes as JSON (whatever the ending), in double, in place of the file if it is there.
/// Throws std::invalid_argument, nothing written, for numbers that are not finite and strokes without points;
/// std::runtime_error if the file cannot be written.
void write_strokes(const std::filesystem::path& path, const std::vector<geometry::Stroke>& strokes,
                   const WriteOptions& options = {});
void write_strokes(std::ostream& out, const std::vector<geometry::Stroke>& strokes,
                   const WriteOptions& options = {});

}  // namespace furrow::io
