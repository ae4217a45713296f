// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <span>

#include "physics/base/arrays.h"

namespace furrow::physics {

/// Where two primitives are nearest to each other: across = sum of weights[i] x_i over their four vertices,
/// and its length is the distance. The weights sum to 0, and the derivative of the distance with respect to
/// x_i is weights[i] across / distance, as closest points answer no first-order change.
struct PairDistance {
  Vec3 across;                    ///< from the second primitive to the first [m]
  std::array<double, 4> weights;  ///< [-]
  double squared() const { return across.squaredNorm(); }
};

/// Of a vertex x and a triangle (a, b, c), in this order: weights 1, -b0, -b1, -b2 with the barycentrics of
/// the closest point. All seven regions; a triangle without area is treated as its three edges. Some 20 ns.
/// Source: Ericson, Real-Time Collision Detection, 5.1.5.
PairDistance vertex_triangle_distance(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c);

/// Of the segments (a0, a1) and (b0, b1): weights 1 - s, s, -(1 - t), -t. All nine regions; parallel and
/// degenerate segments have one of their closest pairs of points. Some 20 ns.
PairDistance edge_edge_distance(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1);

/// Of two edges, else of a vertex and a triangle, by their corners in this order.
inline PairDistance distance_of(bool edges, const std::array<Vec3, 4>& x) {
  return edges ? edge_edge_distance(x[0], x[1], x[2], x[3])
               : vertex_triangle_distance(x[0], x[1], x[2], x[3]);
}

/// Where four vertices are.
inline std::array<Vec3, 4> corners_of(const std::array<int, 4>& v, std::span<const Vec3> x) {
  return {x[std::size_t(v[0])], x[std::size_t(v[1])], x[std::size_t(v[2])], x[std::size_t(v[3])]};
}

}  // namespace furrow::physics
