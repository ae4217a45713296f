// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>

#include "io/base/camera.h"
#include "io/base/json_fields.h"

namespace furrow::io {

/// The camera of a picture as JSON: {"eye": [x, y, z], "target": [x, y, z], "up": [0, 1, 0], "fov": 28,
/// "size": [width, height]} in metres (y up), degrees and pixels; "parallel": height [m] in place of "fov"
/// for parallel lines of sight. Only eye, target and size must be there. Strict like read_strokes. Throws
/// geometry::ContentError with the place in the text, or the key.
CameraPicture read_camera(const std::filesystem::path& path);
/// The same from an object that is part of another file.
CameraPicture camera_from(const JsonFields::Json& object, const JsonFields& fields);

/// Writes it in double precision, replacing the file if it is there. Throws std::invalid_argument (check()),
/// nothing written, and std::runtime_error if the file cannot be written.
void write_camera(const std::filesystem::path& path, const CameraPicture& picture);
JsonFields::Json to_json(const CameraPicture& picture);

}  // namespace furrow::io
