// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <vector>

#include "io/stroke/stroke_file.h"
#include "jobs/base/inputs.h"

/// Strokes as a list that is read, told and laid on a garment.
namespace furrow::jobs {

/// Those of a stroke file, or those that a wrinkled PLY was made with. Throws as io::read_drawn_strokes(),
/// and geometry::ContentError for a PLY without strokes.
std::vector<io::DrawnStroke> read_stroke_list(const std::filesystem::path& path, const Context& context);

/// Throws std::invalid_argument, naming the stroke, for a width, sharpness or press that cannot be.
void check_shapes(const std::vector<io::DrawnStroke>& strokes);

/// The strokes as points in space, as they lie on the garment [m]. Warns of what was cut off or left out.
std::vector<io::DrawnStroke> lay_on(const std::vector<io::DrawnStroke>& strokes, const io::MeshFile& garment,
                                    const Context& context);

/// One row a stroke; `on_garment`, if there are any: the same strokes as lay_on() gave them.
Json to_json(const std::vector<io::DrawnStroke>& strokes,
             const std::vector<io::DrawnStroke>& on_garment = {});

}  // namespace furrow::jobs
