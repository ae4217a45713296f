// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <vector>

#include "geometry/stroke/stroke.h"
#include "geometry/stroke/stroke_path.h"

namespace furrow::geometry {

/// Height of a fold's cross-section over that of its crest, at `t` half widths from the stroke [-]; t >= 0:
/// (1 - s) (1 + cos pi t) / 2 + s (1 - t), and 0 from t = 1 on. Sharpness s in [0, 1]: 0 is a round bump that
/// leaves the cloth without a crease, 1 a tent with a crease at the crest and at both feet.
double line_profile(double t, double sharpness);
inline constexpr double usual_sharpness = 0.5;  ///< where the stroke names none

struct Lift {
  Vertex vertex;
  double height;  ///< along the surface's normal [m]; < 0 for a valley
};

/// What a line with a width lifts: its own vertices by k = stroke.height, and every other one nearer than
/// half the width to the stroke by k line_profile(). `path` is the stroke as it lies on the cloth, so a
/// coarse and a fine mesh give the same fold. Distances are straight ones in space; that no other layer of
/// cloth moves that lies near by, or the other leg of a fold, only vertices count that ways along edges of
/// rest length 1.5 width / 2 join to the line. `mesh`: with the line, not displaced yet; it is not
/// changed. By ascending vertex, none with height 0. Throws std::invalid_argument if the stroke has no width.
/// Cost: vertices of the region times segments of the path.
std::vector<Lift> lift_by_profile(const Mesh& mesh, std::span<const Vertex> line,
                                  std::span<const StrokeSegment> path, const Stroke& stroke);

/// Mean length of the edges in a line's region over the third of its width: how much too coarse the mesh is
/// for the fold, where it is > 1 [-]. `region` as of line_region(). 0 without edges.
double coarseness(const Mesh& mesh, std::span<const Vertex> region, double width,
                  const std::vector<double>& length_of_edge);

}  // namespace furrow::geometry
