// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <functional>
#include <vector>

#include "geometry/band/refine_band.h"

namespace furrow::geometry {

/// A place on the mesh as a mean of vertices.
struct Between {
  std::array<Vertex, 3> vertices;
  Barycentrics weights;
};

/// What the caller knows of the displaced shape.
struct Displacing {
  /// Where a vertex between others lies once the folds are raised [m]; `place` is its place on the mesh that
  /// refine_band() was given.
  std::function<Point(const Between& between, const FacePoint& place)> at;
  /// This vertex, a new one or one that moved, becomes what `at` was asked for last.
  std::function<void(Vertex)> take;
};

struct DisplacedReport {
  std::size_t inserted = 0, flipped = 0;
  double min_angle_deg = 0;  ///< of the band's faces in the displaced shape [degrees]
};

/// The second pass: steep flanks stretch the band, so edges longer than 1.5 of the sizing in the displaced
/// shape are split, Delaunay flips made in that shape, and new vertices moved to better places, until nothing
/// is too long but edges below 0.2 of the sizing undisplaced: where heights jump no split helps. Last, edges
/// are flipped to lie along the folds (tighten_displaced.h). A flip that meets more than 40 degrees between
/// its faces, or would leave a face with a height below 1 % of its side, is refused. `mesh` is what
/// refine_band left, undisplaced, and stays so; `given` the mesh before that; `displaced` holds the displaced
/// place of every vertex and gets those of the new ones. `band` is kept up to date: chains, places, in_band,
/// split_edges, changed_faces and counts. Throws std::invalid_argument, all unchanged, unless `displaced` and
/// `band` belong to `mesh`; ContentError, all of no use then, where heights jump so much that four times the
/// vertices and 5,000 do not do. O(n log n) a round.
DisplacedReport refine_displaced(Mesh& mesh, const Mesh& given, std::span<const FoldCurve> curves,
                                 std::vector<Point>& displaced, const Displacing& displacing,
                                 BandReport& band, const BandOptions& options = {});

}  // namespace furrow::geometry
