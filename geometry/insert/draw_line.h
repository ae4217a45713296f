// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <map>
#include <set>
#include <vector>

#include "geometry/insert/connect_line.h"
#include "geometry/insert/insert_along_stroke.h"
#include "geometry/stroke/trace_stroke.h"

namespace furrow::geometry {

/// What a round of insert_along_stroke does otherwise than the first.
struct LinePlan {
  enum class Place { clamped, incenter, corner };
  std::map<Face, Place> places;         ///< where a face's node goes; clamped if not named
  std::map<Face, Barycentrics> pinned;  ///< in place of CrossedFace::node
  std::set<Edge> routed;                ///< crossed edges that are neither flipped nor split
};

/// One round: a line drawn into a copy of the mesh.
struct DrawnLine {
  Mesh mesh;
  Insertion insertion;
  std::map<Vertex, Face> inserted_in;  ///< new vertices of faces
  std::vector<Link> links;             ///< of consecutive nodes
};

/// Inserts, joins, flips and restores the Delaunay property; see insert_along_stroke. `mean_edge` is h [m].
DrawnLine draw_line(const Mesh& mesh, const TracedStroke& traced, const LinePlan& plan, int line_id,
                    double mean_edge, const InsertionOptions& options);

}  // namespace furrow::geometry
