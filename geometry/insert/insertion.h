// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <functional>
#include <optional>

#include "geometry/mesh/mesh.h"

/// Options of the operations that insert vertices into faces (method S1.2, S1.3: Algorithm 2).
namespace furrow::geometry {

enum class InsertionRule {
  safe,   ///< guarded flips, clamped positions, complete lines, Delaunay flips beside the line
  paper,  ///< every original inner edge of a selected face flipped once; it may fold faces over
};

/// Why an edge was not flipped.
enum class Refusal {
  border,          ///< only one face
  seam,            ///< texture coordinates, group or material differ across it
  line_edge,       ///< an edge of a drawn line
  duplicate_edge,  ///< the flipped edge exists already
  not_convex,      ///< the flip would fold a face over in the rest metric or in the texture chart
  valence,         ///< a vertex would keep fewer than three edges (two on the border)
  layer,           ///< InsertionOptions::may_flip said no
  quality,         ///< the flip led to an angle below min_angle_deg: the line goes through a corner instead
};
const char* to_string(Refusal refusal);

struct InsertionOptions {
  InsertionRule rule = InsertionRule::safe;
  double max_distance = 0.05;    ///< of a stroke's point from the surface [m]; > 0
  double min_barycentric = 0.2;  ///< of a new vertex in its face [-]; [0, 1/3]; safe rule
  double min_angle_deg = 8;      ///< aimed at in the rest metric [degrees]; [0, 30]; safe rule
  /// h: mean rest edge of the mesh before the first line [m]; > 0; none: of the mesh given.
  std::optional<double> mean_edge;
  /// Asked before a flip of the edge 0-1 to 2-3; says whether the surface may sweep over the tetrahedron.
  /// Empty: yes.
  std::function<bool(const std::array<Point, 4>&)> may_flip;
};
/// Throws std::invalid_argument that names the option and its value.
void check(const InsertionOptions& options);

}  // namespace furrow::geometry
