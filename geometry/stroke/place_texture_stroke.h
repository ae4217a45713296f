// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <span>
#include <string>

#include "geometry/mesh/property_names.h"
#include "geometry/stroke/placed_stroke.h"

namespace furrow::geometry {

/// Which of the faces that share a place in the texture is meant (mirrored halves of a garment).
struct TextureChoice {
  std::optional<int> group;   ///< only faces of that attribute::group
  std::optional<Point> near;  ///< the face nearest to this point [m]
};

/// Lays a stroke that was drawn in texture space (attribute::texture) onto the surface. From point to point
/// it runs straight in the texture; across a seam it goes on from the same place on the other chart.
/// `closed`: the last point is joined to the first. `max_distance` is that of the trace that follows [m]
/// (placed_stroke.h). Throws ContentError, naming stroke and point, if a point lies in no face's texture
/// triangle or is not finite, or the mesh has no texture coordinates. Cost: O(faces) for each point.
/// \details A chart is a set of faces joined by edges across which the texture coordinates agree, a seam an
/// edge between two charts. If the next point does not lie on the other chart, the stroke ends at the seam
/// and starts anew (a warning). Among several faces at a point the first point takes the one in `choice`,
/// else that of the lowest index (a warning if they lie apart); later points stay on the chart of the one
/// before where they can.
PlacedStroke place_texture_stroke(const Mesh& mesh, std::span<const TextureCoordinate> points, bool closed,
                                  const TextureChoice& choice, const std::string& stroke_name,
                                  double max_distance = TraceOptions{}.max_distance);

}  // namespace furrow::geometry
