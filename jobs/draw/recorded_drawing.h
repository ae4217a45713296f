// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
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

}  // namespace furrow::jobs
