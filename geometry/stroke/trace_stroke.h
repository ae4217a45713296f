// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "geometry/stroke/project_onto_surface.h"
#include "geometry/stroke/stroke.h"
#include "geometry/stroke/walk_surface.h"

namespace furrow::geometry {

/// A visit of a stroke to a face.
struct CrossedFace {
  Face face;
  std::optional<EdgeCrossing>
      entry;  ///< `halfedge` belongs to this face; none where the sub-stroke starts inside
  std::optional<EdgeCrossing> exit;  ///< likewise; may lie on the border
  std::size_t samples = 0;           ///< of the stroke's points, in this face, over all visits
  Barycentrics node{};               ///< of the vertex to be inserted; the same for all visits of a face
  double stroke_parameter = 0;       ///< of this visit, by chord length [-]; [0, 1]
};

/// A part of a stroke without a gap: each face shares the edge `exit` with the next one.
struct SubStroke {
  std::vector<CrossedFace> faces;
  bool closed = false;  ///< the last face leads to the first, which is not repeated
};

/// A point of the stroke on the cloth.
struct ProjectedSample {
  Point position;  ///< [m]
  FacePoint point;
  std::size_t index;  ///< into Stroke::points
};

struct TracedStroke {
  std::vector<SubStroke> sub_strokes;
  std::vector<ProjectedSample> samples;  ///< those on cloth
  std::vector<std::string> warnings;     ///< breaks of the stroke
  std::size_t nudges = 0;                ///< times that it was moved aside by 1e-3 h from vertices and edges
};

struct TraceOptions {
  double max_distance =
      0.05;              ///< of a point from the surface, along Stroke::direction if there is one [m]; > 0
  double mean_edge = 0;  ///< h, the mesh's length scale [m]; > 0
};

/// Finds the faces that a stroke crosses, in order (method S1.2). The points are projected to the closest
/// point, or along Stroke::direction to the first face that faces them; faces between are walked along the
/// plane through two hits and their mean normal, so that none is missed. Throws ContentError, naming stroke
/// and point, if a point is not finite, misses the surface or is farther than max_distance, or if no point
/// lies on cloth; std::invalid_argument if an option is out of range.
/// \details A step never leaps to another layer: where the walk to a hit is longer than 3 |AB| + 4 h, the
/// closest point that is connected nearby takes its place, and if there is none the stroke breaks (a
/// warning). It also breaks where it leaves the cloth: at points more than h/2 beyond the border. A node lies
/// at the mean of the barycentrics of the samples in the face, else at the mid-point of the part inside.
TracedStroke trace_stroke(const Mesh& mesh, const SurfaceProjector& projector, const Stroke& stroke,
                          const TraceOptions& options);

}  // namespace furrow::geometry
