// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

/// A vertex of one border amid an edge of the other, which is to be split there.
struct SeamSplit {
  Halfedge border;  ///< of that edge
  double t;         ///< from the border's source, in (0, 1) [-]
  Vertex at;
};

/// Where borders of a mesh run along each other, so that they should be joined.
struct BorderSeams {
  std::vector<std::array<Vertex, 2>> pairs;  ///< the lower first, ascending; those at one place, too
  std::vector<Vertex> apart;                 ///< the second ones of pairs that do not lie at one place
  std::vector<SeamSplit> splits;             ///< by border; along one border ascending
  double gap = 0;                            ///< widest [m]
  double tolerance = 0;                      ///< widest that would be a seam at these places [m]
  bool any() const { return !pairs.empty() || !splits.empty(); }
};

struct SeamOptions {
  bool within_groups = false;  ///< only borders of faces of one attribute::group are seen beside each other
  bool split = true;           ///< edges that vertices of the other border lie amid
  bool closed = false;         ///< runs without any gap are seams, too
};

/// Finds the seams that lie open by a rounding: border edges that run opposite ways along each other, both
/// ends within the tolerance, 1/100 of the shortest border edge at the two vertices; the mesh stays. A run of
/// such edges is a seam where it is longer than three edges and, at both ends, closed, or the borders turn
/// away from each other by more than a tenth: sides that go on side by side, but farther apart, are those of
/// a slit that lies open on purpose. Within the rounding of single precision any run is one. A run without
/// any gap is none unless asked for, nor faces that lie on each other (two layers with one outline), nor what
/// ties hold.
/// \details Splits are looked for along edges that no other edge runs along. Cost: O(edges); of a border of n
/// vertices O(n log n), and for each what lies as near to a skew plane through it. Throws
/// std::invalid_argument for a mesh that require_structure() refuses, ContentError for positions that are not
/// finite.
BorderSeams find_border_seams(const Mesh& mesh, const SeamOptions& options = {});

/// By vertex: the lowest that it is joined with, itself where it is not.
std::vector<Vertex> joined_vertices(const Mesh& mesh, const BorderSeams& seams);

/// Puts what is one with another vertex at a seam (attribute::joined), and has no face, at its place.
void close_joined(Mesh& mesh);

}  // namespace furrow::geometry
