// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/stroke/stroke_file.h"
#include "jobs/base/inputs.h"
#include "jobs/base/read_inputs.h"

namespace furrow::jobs {

/// What a wrinkled PLY was made of.
struct RecordedDrawing {
  std::filesystem::path garment;
  std::vector<io::DrawnStroke> strokes;
  std::string options;  ///< the flags of `furrow wrinkle` that it was drawn with
  bool was_kept;        ///< its shape was made to bear its weight; drawing again does not
};

/// The untouched garment and the strokes of a wrinkled mesh, to be drawn again. Throws std::invalid_argument
/// if it holds no strokes, geometry::ContentError if its garment is not there or has changed.
RecordedDrawing recorded_drawing(const std::filesystem::path& wrinkled, const Context& context);

/// A scene as it was before its garment was drawn on.
struct UndrawnScene {
  io::Scene scene;
  MemoryFiles memory;  ///< the context's, and the strokes of the scene's lines
};

/// The scene of a wrinkled mesh with the garment that it was made of, and its lines as lines of time 0, so
/// that they can be drawn anew where the garment comes to lie. None: the scene has lines of its own or its
/// garment in memory; the mesh holds no strokes, or not its garment; it has moved since it was drawn, or its
/// shape is made to bear its weight.
std::optional<UndrawnScene> undrawn(const io::Scene& scene, const Context& context);

}  // namespace furrow::jobs
