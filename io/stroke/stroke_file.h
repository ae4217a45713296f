// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh/mesh_file.h"
#include "io/stroke/drawn_stroke.h"

namespace furrow::io {

/// Reads strokes by the file name's ending, json or obj. Points and directions are turned, and points scaled,
/// by `options`; heights, widths and cameras are in metres, y up, always. Strict: unknown keys, wrong types
/// and numbers that are not finite are errors. obj: the polylines (`l` elements, two-point ones chained), all
/// with the default height. Throws geometry::ContentError with the place in the text, or the stroke's index
/// and key; also if there is no stroke. Throws std::invalid_argument if default_height [m] is not finite.
///
/// \details json is
///     {"strokes": [{"name": "…", "height": 0.02, "width": 0.06, "sharpness": 0.5, "press": 1,
///                   "closed": false, …}, …]}
/// Each stroke must have one of these (a closed stroke at least three items); the other keys may be missing.
/// - "points": [[x, y, z], …], with "direction": [x, y, z] and "breaks": [index, …];
/// - "pixels": [[column, row], …], with "camera": an object or the name of a file (camera_file.h) beside this
///   one; a "camera" beside "strokes" serves all;
/// - "texture": [[u, v], …], with "group": "…" and "near": [x, y, z];
/// - "vertices": [index, …], counted from 0.
std::vector<DrawnStroke> read_drawn_strokes(const std::filesystem::path& path, double default_height = 0.01,
                                            const ReadOptions& options = {});
/// The same for the text of a json file, which may hold no stroke; `name` stands in messages.
std::vector<DrawnStroke> drawn_strokes_from(std::string_view json, const std::string& name,
                                            const ReadOptions& options = {});
/// The same for a file whose strokes are all drawn in space ("points"); any other stroke is an error.
std::vector<geometry::Stroke> read_strokes(const std::filesystem::path& path, double default_height = 0.01,
                                           const ReadOptions& options = {});

/// Writes strokes as JSON (whatever the ending), in double precision, cameras included, replacing the file if
/// it is there. Throws std::invalid_argument, nothing written, for numbers that are not finite and strokes
/// without points; std::runtime_error if the file cannot be written.
void write_strokes(const std::filesystem::path& path, const std::vector<DrawnStroke>& strokes,
                   const WriteOptions& options = {});
void write_strokes(std::ostream& out, const std::vector<DrawnStroke>& strokes,
                   const WriteOptions& options = {});
void write_strokes(const std::filesystem::path& path, const std::vector<geometry::Stroke>& strokes,
                   const WriteOptions& options = {});
void write_strokes(std::ostream& out, const std::vector<geometry::Stroke>& strokes,
                   const WriteOptions& options = {});

}  // namespace furrow::io
