// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geometry/mesh/mesh_fwd.h"

/// Options and reports of the operations that insert vertices into faces (method S1.2, S1.3: Algorithm 2).
namespace furrow::geometry {

enum class InsertionRule {
  safe,   ///< guarded flips, clamped positions, complete lines, Delaunay flips beside the line
  paper,  ///< every original inner edge of a selected face flipped once; it may fold faces over
  /// Of wrinkle() alone: a band of fine triangles around a smooth curve (geometry/fold/fold_lines.h).
  fold,
};

/// How fine the mesh around a fold becomes (rule fold): edges of 1.4, 1 and 0.7 times the rule's.
enum class Detail { coarse, normal, fine };

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
  std::optional<double> mean_edge = {};
  /// Asked before a flip of the edge 0-1 to 2-3; says whether the surface may sweep over the tetrahedron.
  /// Empty: yes.
  std::function<bool(const std::array<Point, 4>&)> may_flip = {};
};
/// Throws std::invalid_argument that names the option and its value.
void check(const InsertionOptions& options);

/// Two vertices follow each other in a chain, but no edge joins them (paper rule only).
struct MissingLineEdge {
  Index<Vertex> from, to;
  Refusal reason;
};

/// An edge was split at a crossing: chains of earlier lines that hold from, to now go from, vertex, to.
struct SplitEdge {
  Index<Vertex> from, to, vertex;
};

struct InsertionReport {
  std::size_t inserted = 0;        ///< new vertices, those of split edges included
  std::size_t flipped = 0;         ///< edges flipped by Algorithm 2
  std::size_t delaunay_flips = 0;  ///< edges flipped afterwards, beside the line
  std::size_t folded_flips = 0;    ///< flips that folded a face over in the rest metric (paper rule only)
  std::size_t reused = 0;          ///< crossed faces that took a vertex of an earlier line
  std::size_t snapped = 0;         ///< crossed faces that took another corner instead of a new vertex
  std::size_t too_small = 0;       ///< of the snapped faces: too small or split too often already
  std::size_t routed = 0;    ///< pairs of consecutive faces joined through corners, each after a refused flip
  std::size_t attempts = 1;  ///< rounds of the search for a line with good angles
  std::size_t nudges = 0;    ///< times that the stroke was moved aside from vertices and edges
  std::map<Refusal, std::size_t> refused_flips;  ///< of Algorithm 2, not of the Delaunay flips
  std::vector<SplitEdge> split_edges;
  std::vector<MissingLineEdge> missing_edges;
  std::vector<std::string> warnings;
  std::vector<Index<Face>> changed_faces;  ///< new or other corners than before; ascending
  double min_angle_deg = 0;                ///< rest metric, over changed_faces [degrees]
  double max_deviation = 0;                ///< largest distance of a sample on cloth from the line [m]
};

/// Adds another line's report: counts and lists grow, the smaller angle and the larger deviation stay.
InsertionReport& operator+=(InsertionReport& sum, const InsertionReport& line);

}  // namespace furrow::geometry
