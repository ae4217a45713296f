// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "physics/base/arrays.h"
#include "physics/base/float4.h"

namespace furrow::physics {

/// Finite: what is no number, or goes beyond what single precision holds, has failed anyway, and must not
/// lead a search out of its arrays.
inline float bounded_float(double coordinate) {
  constexpr double most = 1e30;
  return float(coordinate < most ? (coordinate > -most ? coordinate : -most) : most);
}

/// A point in single precision around an origin, so that little is lost; its fourth lane is the largest size
/// of a coordinate, of which rounding is a share.
inline Float4 float_point(const Vec3& x, const Vec3& origin) {
  const Vec3 p = x - origin;
  return Float4{bounded_float(p.x()), bounded_float(p.y()), bounded_float(p.z()),
                bounded_float(std::max({std::abs(p.x()), std::abs(p.y()), std::abs(p.z())}))};
}

/// The four vertices of four pairs, as PairDistance has them, a pair a lane.
struct FourPairs {
  struct Points {
    Float4 x, y, z;
  };
  std::array<Points, 4> at;
  Float4 size;  ///< largest coordinate of each pair's vertices [m]
};

/// points: those of the first pair, of the second, ….
inline FourPairs four_pairs(const std::array<const Float4*, 16>& points) {
  FourPairs pairs;
  pairs.size = splat(0);
  for (std::size_t i = 0; i < 4; ++i) {
    const Float4 p = *points[i], q = *points[4 + i], r = *points[8 + i], s = *points[12 + i];
    const Float4 pq = __builtin_shufflevector(p, q, 0, 4, 1, 5),
                 rs = __builtin_shufflevector(r, s, 0, 4, 1, 5);
    const Float4 pq2 = __builtin_shufflevector(p, q, 2, 6, 3, 7),
                 rs2 = __builtin_shufflevector(r, s, 2, 6, 3, 7);
    pairs.at[i] = {__builtin_shufflevector(pq, rs, 0, 1, 4, 5), __builtin_shufflevector(pq, rs, 2, 3, 6, 7),
                   __builtin_shufflevector(pq2, rs2, 0, 1, 4, 5)};
    pairs.size = max(pairs.size, __builtin_shufflevector(pq2, rs2, 2, 3, 6, 7));
  }
  return pairs;
}

/// A plane between the two primitives of each of four pairs: they are at least gap / sqrt(squared) - slack
/// apart. Where they nearly touch the gap may be less than 0.
struct Separation {
  Float4 gap, squared;
  Float4 slack;  ///< by which rounding may be wrong [m]

  /// By lane, all bits: they are surely farther than so from each other [m]; >= 0.
  auto beyond(Float4 distance) const {
    const Float4 least = distance + slack;
    return (gap > splat(0)) & (gap * gap > least * least * squared);
  }
  /// Their distance is at least this [m]; may be less than 0.
  float bound(std::size_t lane) const {
    return (gap[lane] > 0 ? gap[lane] / std::sqrt(squared[lane]) : 0.0f) - slack[lane];
  }
};

namespace pair_bounds_detail {

using Points = FourPairs::Points;
inline Points operator-(const Points& a, const Points& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Points operator+(const Points& a, const Points& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Points operator*(Float4 s, const Points& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Float4 dot(const Points& a, const Points& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Float4 share(Float4 part, Float4 whole) { return clamp01(part / max(whole, splat(1e-30f))); }

/// Coordinates are off by half a unit in the last place of the largest, sums of products of them and of their
/// differences by less than sixty.
inline Float4 slack(const FourPairs& pairs) {
  return splat(32 * std::numeric_limits<float>::epsilon()) * pairs.size;
}

/// The nearer of two ways, by lane.
inline void take_nearer(Points& way, Float4& squared, const Points& other) {
  const Float4 others = dot(other, other);
  const auto nearer = others < squared;
  way = {nearer ? other.x : way.x, nearer ? other.y : way.y, nearer ? other.z : way.z};
  squared = nearer ? others : squared;
}

}  // namespace pair_bounds_detail

/// How much nearer the two of each pair come at most by such moves, without what all four have in common [m].
inline Float4 relative_approach(const FourPairs& move, bool edges) {
  using namespace pair_bounds_detail;
  const Points mean = splat(0.25f) * ((move.at[0] + move.at[1]) + (move.at[2] + move.at[3]));
  std::array<Float4, 4> way;
  for (std::size_t i = 0; i < 4; ++i) {
    const Points own = move.at[i] - mean;
    way[i] = dot(own, own);
  }
  const Float4 first = edges ? max(way[0], way[1]) : way[0];
  const Float4 second = edges ? max(way[2], way[3]) : max(max(way[1], way[2]), way[3]);
  constexpr float rounds = 32 * std::numeric_limits<float>::epsilon();
  return splat(1 + rounds) * (square_root(first) + square_root(second)) + splat(rounds) * move.size;
}

/// Of the edges (0, 1) and (2, 3). The plane is across the line between points that are the nearest but for
/// rounding, so little is lost unless the edges are nearly parallel, and the bound holds whatever they are.
inline Separation edge_edge_separation(const FourPairs& pairs) {
  using namespace pair_bounds_detail;
  const Points e = pairs.at[1] - pairs.at[0], f = pairs.at[3] - pairs.at[2], r = pairs.at[0] - pairs.at[2];
  const Float4 ee = dot(e, e), ff = dot(f, f), ef = dot(e, f), er = dot(e, r), fr = dot(f, r);
  const Float4 s0 = share(ef * fr - er * ff, ee * ff - ef * ef), t = share(ef * s0 + fr, ff);
  const Float4 s = share(ef * t - er, ee);
  const Points n = r + s * e - t * f;
  const Float4 first = dot(n, r), along = dot(n, e);
  const Float4 gap = min(first, first + along) - max(splat(0), dot(n, f));
  return {gap, dot(n, n), slack(pairs)};
}

/// Of the vertex 0 and the triangle (1, 2, 3), likewise.
inline Separation vertex_triangle_separation(const FourPairs& pairs) {
  using namespace pair_bounds_detail;
  const Points ab = pairs.at[2] - pairs.at[1], ac = pairs.at[3] - pairs.at[1], ax = pairs.at[0] - pairs.at[1];
  const Float4 bb = dot(ab, ab), bc = dot(ab, ac), cc = dot(ac, ac), xb = dot(ax, ab), xc = dot(ax, ac);
  Points n = ax - share(xb, bb) * ab;
  Float4 squared = dot(n, n);
  take_nearer(n, squared, ax - share(xc, cc) * ac);
  const Points third = ac - ab, bx = ax - ab;
  take_nearer(n, squared, bx - share(dot(bx, third), dot(third, third)) * third);
  const Float4 area2 = bb * cc - bc * bc, v = cc * xb - bc * xc, w = bb * xc - bc * xb, zero = splat(0);
  const auto inside = (v >= zero) & (w >= zero) & (v + w <= area2);
  const Float4 per_area = splat(1) / max(area2, splat(1e-30f));
  const Points straight = ax - (v * per_area) * ab - (w * per_area) * ac;
  n = {inside ? straight.x : n.x, inside ? straight.y : n.y, inside ? straight.z : n.z};
  const Float4 gap = dot(n, ax) - max(zero, max(dot(n, ab), dot(n, ac)));
  return {gap, dot(n, n), slack(pairs)};
}

}  // namespace furrow::physics
