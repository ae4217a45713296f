// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <string>

#include "geometry/stroke/placed_stroke.h"
#include "geometry/stroke/project_onto_surface.h"

namespace furrow::geometry {

/// The line of sight through a point of a picture.
struct SightLine {
  Point origin;      ///< the eye, or a point of the picture's plane if all lines of sight are parallel [m]
  Vector direction;  ///< unit length, away from the viewer
};

/// Lays a stroke that was drawn on a picture onto what the picture shows. Each line of sight takes the first
/// face that it meets from outside (if there is none, the first: the inside of the cloth). From hit to hit
/// the stroke follows the surface along the plane of sight, so that in the picture it stays under the line
/// that was drawn. `parallel`: the lines of sight are; otherwise all have one origin. `closed`: the last
/// point is joined to the first. `max_distance` is that of the trace that follows [m]. Throws ContentError
/// that names stroke and point if all miss or a number is not finite. Cost: O(log faces) a point and a
/// crossed face.
/// \details It never jumps: where the way is longer than 3 |AB| + 4 h (h the mean edge), or there is none, as
/// to another layer or component, the stroke ends where the cloth goes out of sight and starts anew (a
/// warning). Lines of sight that miss the mesh cut the stroke at the outline (a warning); at the border of
/// the mesh it runs over it.
PlacedStroke place_view_stroke(const Mesh& mesh, const SurfaceProjector& projector,
                               std::span<const SightLine> sight, bool parallel, bool closed,
                               const std::string& stroke_name,
                               double max_distance = TraceOptions{}.max_distance);

}  // namespace furrow::geometry
