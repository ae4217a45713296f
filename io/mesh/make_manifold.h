// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstddef>
#include <vector>

namespace furrow::io {

/// A triangle of points, and the corner of the file that each of its corners comes from.
struct SoupTriangle {
  std::array<std::size_t, 3> points;
  std::array<std::size_t, 3> corners;
  std::size_t face;  ///< of the file
};

struct ManifoldReport {
  /// The point that the k-th new one (index n_points + k) is a copy of.
  std::vector<std::size_t> added_points;
  std::size_t reversed_faces = 0;
};

/// Turns and parts triangles so that they form an oriented manifold, perhaps with border:
/// 1. across an edge of exactly two triangles both get the same orientation, walking from the first triangle
///    of each component; where a component needs fewer turns the other way round, it is turned whole;
/// 2. triangles stay joined across such an edge only (not where three meet, nor where a Möbius strip would
///    close); at each point every fan of joined triangles gets a point of its own: the fan with the first
///    corner keeps the index, the others get new ones from n_points on, in the order of their first corners.
/// Triangles keep their order and no face is lost. Distinct points within each triangle are presumed.
/// Cost: O(F log F).
ManifoldReport make_manifold(std::vector<SoupTriangle>& triangles, std::size_t n_points);

}  // namespace furrow::io
