// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <string>
#include <vector>

#include "io/drawn_stroke.h"
#include "io/mesh_file.h"

namespace furrow::io {

struct ResolvedStrokes {
  std::vector<geometry::Stroke> strokes;  ///< one for each that was drawn, in space
  std::vector<std::string> warnings;      ///< where one was cut or parted
};

/// Lays strokes that were drawn on pictures, in texture space or between vertices onto a garment, as ordinary
/// strokes in space whose points lie on it; those drawn in space stay as they are. Vertices are those of
/// `garment.mesh`. Throws geometry::ContentError, naming the stroke, for one that cannot be laid on: see
/// geometry/place_view_stroke.h, place_texture_stroke.h, place_path_stroke.h, also for the cost.
ResolvedStrokes resolve_strokes(std::span<const DrawnStroke> strokes, const MeshFile& garment);

}  // namespace furrow::io
