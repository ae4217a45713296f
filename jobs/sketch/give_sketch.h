// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>

#include "jobs/sketch/sketch.h"

namespace furrow::jobs {

/// Writes a sketch as it is shown, for another program, into `folder`, which is made if it is not there,
/// under the garment's name. `as`: "ply", "obj", "glb"; "original", which is the shape on the vertices and
/// faces of the file `original`, in that file's format (jobs/mesh/transfer.h); or "maps", which are the
/// normals and heights that this shape misses of the sketch's, for the original's texture coordinates
/// (jobs/mesh/bake.h). A file of that name is replaced. Returns the path, of maps that of the displacements.
/// Throws std::invalid_argument for another word, and as draw_sketch(), transfer() and the writers.
std::filesystem::path give_sketch(const Sketch& sketch, const Json& strokes, const std::string& as,
                                  const std::filesystem::path& original, const std::filesystem::path& folder,
                                  Listener& listener);

/// What a garment is called by its path, in names of files.
std::string title_of(const std::filesystem::path& garment);

}  // namespace furrow::jobs
