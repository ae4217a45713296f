// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "geometry/insert/insertion.h"
#include "geometry/stroke/stroke.h"
#include "geometry/stroke/stroke_path.h"

namespace furrow::geometry {

struct LineVertex {
  Vertex vertex;
  Vector normal;            ///< unit; the direction of the displacement
  double stroke_parameter;  ///< where along the stroke, by chord length [-]; [0, 1]
};

/// A drawn line as a chain of edges.
struct InsertedLine {
  int id = -1;
  std::vector<std::vector<Vertex>> chains;  ///< one a sub-stroke, in order; closed: first == last
  std::vector<LineVertex> vertices;         ///< each vertex once, by first appearance
};

struct Insertion {
  InsertedLine line;
  InsertionReport report;
  std::vector<StrokeSegment> path;  ///< the stroke as it lies on the cloth
};

/// Draws one line into a mesh (method S1.2, S1.3, Algorithm 2) as a chain of edges. It is not displaced;
/// displacement along LineVertex::normal, smoothing and new rest lengths (method S1.4, S1.5, S1.18) are
/// operations of their own. Adds vertices, edges and faces at the end; no index changes; attributes follow
/// their rules (attribute_register.h). Fetch property maps of `mesh` again afterwards. Throws
/// std::invalid_argument for an option or line_id < 0, ContentError for the stroke (trace_stroke.h), a
/// degenerate face below it, or a mesh that is not of triangles; the mesh is unchanged then. Cost: O(n log n)
/// for the search tree, O(n) a round, n the faces of the mesh.
/// \details The faces that the stroke crosses (trace_stroke.h) are selected. The safe rule puts a vertex into
/// each, with barycentrics of at least min_barycentric, or takes a corner instead: one of an earlier line
/// within h/2, or the nearest one if the face is too small (longest rest edge < 1.5 h_min, area < sqrt(3)/4
/// h_min^2, h_min = h/4) or was split twice already. Consecutive vertices are joined by flips
/// (connect_line.h). Then come the guarded flips of the other original edges and Delaunay flips beside the
/// line. Where the smallest rest angle of the changed faces stays below min_angle_deg and below that of the
/// faces crossed and their neighbours, the vertices at the bad faces go to the incenter, then to a corner,
/// and the line is drawn anew, 12 times at most; the best line stays. The paper's rule inserts at the mean or
/// mid-point and flips every original inner edge of a selected face once. attribute::line of the line's
/// vertices becomes `line_id`, attribute::line_edge is set on its edges, attribute::rest_length everywhere.
Insertion insert_along_stroke(Mesh& mesh, const Stroke& stroke, int line_id,
                              const InsertionOptions& options = {});

}  // namespace furrow::geometry
