// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <span>
#include <vector>

#include "physics/pairs/edge_face_crossings.h"

namespace furrow::physics {

/// A crossing on a contour along which cloth passes through cloth.
struct ContourCrossing {
  EdgeFaceCrossing crossing;
  int side = 0;  ///< of the two pieces of cloth that pass through each other there, the one of the edge
  Vec3 at = Vec3::Zero();      ///< [m]
  Vec3 normal = Vec3::Zero();  ///< of the triangle; of length 1, 0 where it has no area
  /// How much shorter the contour becomes if the edge moves and the triangle as far the other way [-].
  Vec3 shortening = Vec3::Zero();
};

/// Crossings that hang together: the line in which two pieces of a cloth cross.
struct TangleContour {
  std::vector<ContourCrossing> crossings;
  double length = 0;  ///< [m]
  Vec3 middle() const;
};

/// Of each edge of a mesh the triangles that have it, two at most; -1: none.
std::vector<std::array<int, 2>> triangles_of_edges(const PairMesh& mesh);

/// Chains crossings at x to contours: those in which the same two triangles cross are neighbours. With E the
/// edge, N the triangle's normal, R the sum of the unit directions to a crossing's neighbours, its shortening
/// is R - 2 (E.R) / (E.N) N, |E.N| being 0.1 at least. Contours and what is in them come in the order of the
/// crossings. Private.
std::vector<TangleContour> tangle_contours(const PairMesh& mesh, std::span<const Vec3> x,
                                           std::span<const EdgeFaceCrossing> crossings,
                                           std::span<const std::array<int, 2>> triangles_of_edge);

}  // namespace furrow::physics
