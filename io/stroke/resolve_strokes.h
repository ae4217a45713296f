// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <string>
#include <vector>

#include "geometry/stroke/trace_stroke.h"
#include "io/mesh/mesh_file.h"
#include "io/stroke/stroke_file.h"

namespace furrow::io {

struct ResolvedStrokes {
  std::vector<geometry::Stroke> strokes;  ///< one for each that was drawn, in space
  std::vector<std::string> warnings;      ///< where one was cut or parted
};

/// Lays strokes that were drawn on pictures, in texture space or between vertices onto a garment, as ordinary
/// strokes in space whose points lie on it. Strokes drawn in space stay as they are. Vertices are those of
/// `garment.mesh`. `max_distance` is that of the insertion or the trace that follows [m]: a line that runs
/// over the border gets a point beyond it, but none farther than this. Throws geometry::ContentError, naming
/// the stroke, for one that cannot be laid on. For that and for the cost see
/// geometry/stroke/place_view_stroke.h, place_texture_stroke.h and place_path_stroke.h.
ResolvedStrokes resolve_strokes(std::span<const DrawnStroke> strokes, const MeshFile& garment,
                                double max_distance = geometry::TraceOptions{}.max_distance);

}  // namespace furrow::io
