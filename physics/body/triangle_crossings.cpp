// SPDX-License-Identifier: MIT
#include "physics/body/triangle_crossings.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "physics/base/cancel_scope.h"

namespace furrow::physics {
namespace {

using Corners = std::array<Vec3, 3>;
constexpr int triangles_a_question = 256;

/// In the plane of the triangle: no line along one of its edges, nor along the segment, parts the two.
bool meet_in_plane(const Vec3& p, const Vec3& q, const Corners& t, const Vec3& n, double slack) {
  const auto parted = [&](const Vec3& from, const Vec3& to) {
    const Vec3 across = n.cross(to - from);
    const double length = across.norm();
    if (length == 0) return false;
    double triangle_low = 1e300, triangle_high = -1e300;
    for (const Vec3& corner : t) {
      const double d = across.dot(corner - from) / length;
      triangle_low = std::min(triangle_low, d);
      triangle_high = std::max(triangle_high, d);
    }
    const double dp = across.dot(p - from) / length, dq = across.dot(q - from) / length;
    return std::max(dp, dq) < triangle_low - slack || std::min(dp, dq) > triangle_high + slack;
  };
  return !parted(t[0], t[1]) && !parted(t[1], t[2]) && !parted(t[2], t[0]) && !parted(p, q);
}

bool folded(const Vec3& m, const Vec3& n) { return m.dot(n) < -1 + 1e-9; }

/// Pair that shares no edge; `shared` counts common corners (0 or 1), which come first in s and t.
bool pair_meets(const Corners& s, const Corners& t, int shared) {
  if (shared == 1)
    return segment_meets_triangle(s[1], s[2], t[0], t[1], t[2]) ||
           segment_meets_triangle(t[1], t[2], s[0], s[1], s[2]);
  for (int k = 0; k < 3; ++k)
    if (segment_meets_triangle(s[k], s[(k + 1) % 3], t[0], t[1], t[2]) ||
        segment_meets_triangle(t[k], t[(k + 1) % 3], s[0], s[1], s[2]))
      return true;
  return false;
}

Corners starting_at(const Corners& t, int k) { return {t[k], t[(k + 1) % 3], t[(k + 2) % 3]}; }

bool may_meet(const TriangleBvh& bvh, const SurfaceTopology& topology, int i, int j) {
  const auto &s = topology.triangles[i], &t = topology.triangles[j];
  int shared = 0, in_s = 0, in_t = 0;
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l)
      if (s[k] == t[l]) ++shared, in_s = k, in_t = l;
  if (shared >= 2) return shared > 2 || folded(topology.normals[i], topology.normals[j]);
  if (shared == 0) return pair_meets(bvh.corners(i), bvh.corners(j), 0);
  return pair_meets(starting_at(bvh.corners(i), in_s), starting_at(bvh.corners(j), in_t), 1);
}

bool boxes_apart(const Corners& s, const Corners& t, double slack) {
  for (int k = 0; k < 3; ++k) {
    const auto [s_low, s_high] = std::minmax({s[0][k], s[1][k], s[2][k]});
    const auto [t_low, t_high] = std::minmax({t[0][k], t[1][k], t[2][k]});
    if (s_high + slack < t_low || t_high + slack < s_low) return true;
  }
  return false;
}

/// Triangles at a vertex that more than a thousand share. Each lies in the boxes of all others there, so that
/// their pairs would take quadratic time.
std::vector<char> crowded_triangles(const SurfaceTopology& topology) {
  constexpr int crowd = 1000;
  std::vector<int> uses(std::size_t(topology.vertices), 0);
  for (const auto& t : topology.triangles)
    for (int v : t) ++uses[std::size_t(v)];
  std::vector<char> crowded;
  for (const auto& t : topology.triangles)
    crowded.push_back(std::any_of(t.begin(), t.end(), [&](int v) { return uses[std::size_t(v)] > crowd; }));
  return crowded;
}

}  // namespace

bool segment_meets_triangle(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a, aq = q - a;
  const Vec3 n = ab.cross(ac);
  const double size =
      std::sqrt(std::max({ab.squaredNorm(), ac.squaredNorm(), ap.squaredNorm(), aq.squaredNorm()}));
  const double slack = 1e-9 * size, area = n.norm();
  if (area <= 1e-9 * size * size) {  // no plane to speak of: box against box
    return !boxes_apart({p, q, q}, {a, b, c}, slack);
  }
  const double dp = n.dot(ap) / area, dq = n.dot(aq) / area;
  if ((dp > slack && dq > slack) || (dp < -slack && dq < -slack)) return false;
  if (std::abs(dp) <= slack && std::abs(dq) <= slack) return meet_in_plane(p, q, {a, b, c}, n, slack);
  const Vec3 line = q - p;
  const auto side = [&](const Vec3& u, const Vec3& v) { return line.dot((u - p).cross(v - p)); };
  const double v0 = side(a, b), v1 = side(b, c), v2 = side(c, a), zero = slack * size * size;
  return (v0 >= -zero && v1 >= -zero && v2 >= -zero) || (v0 <= zero && v1 <= zero && v2 <= zero);
}

std::vector<char> crossed_triangles(const TriangleBvh& bvh, const SurfaceTopology& topology) {
  const int count = static_cast<int>(topology.triangles.size());
  std::vector<char> crossed(count, 0);
  const std::vector<char> crowded = crowded_triangles(topology);
  std::vector<int> near;
  for (int i = 0; i < count; ++i) {
    if (i % triangles_a_question == 0) throw_if_cancelled("crossed_triangles");
    if (crowded[i]) continue;
    const Corners& s = bvh.corners(i);
    const Vec3 low = s[0].cwiseMin(s[1]).cwiseMin(s[2]), high = s[0].cwiseMax(s[1]).cwiseMax(s[2]);
    const double slack = 1e-9 * (high - low).norm();
    near.clear();
    bvh.append_near(low, high, near);
    for (int j : near) {
      if ((j <= i && !crowded[j]) || (crossed[i] && crossed[j]) || boxes_apart(s, bvh.corners(j), slack))
        continue;
      if (may_meet(bvh, topology, i, j)) crossed[i] = crossed[j] = 1;
    }
  }
  return crossed;
}

}  // namespace furrow::physics
