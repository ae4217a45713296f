// SPDX-License-Identifier: MIT
#include "physics/body/triangle_crossings.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "physics/base/cancel_scope.h"
#include "physics/base/float4.h"

namespace furrow::physics {
namespace {

using Corners = std::array<Vec3, 3>;
constexpr int leaves_a_question = 64;

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

/// Whether all corners of t but those before `from` lie clearly on one side of the plane of s, whose unit
/// normal is n (zero: no).
bool on_one_side(const Corners& s, const Vec3& n, const Corners& t, int from) {
  constexpr double clearly = 1e-8;  // of the size, ten times the slack of what counts as meeting
  int above = 0, below = 0;
  for (int k = from; k < 3; ++k) {
    const Vec3 r = t[k] - s[0];
    const double height = n.dot(r), least = clearly * (r.cwiseAbs().sum() + (s[1] - s[0]).cwiseAbs().sum());
    above += height > least, below += height < -least;
  }
  return above == 3 - from || below == 3 - from;
}

bool may_meet(const TriangleBvh& bvh, const SurfaceTopology& topology, int i, int j) {
  const auto &s = topology.triangles[i], &t = topology.triangles[j];
  int shared = 0, in_s = 0, in_t = 0;
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l)
      if (s[k] == t[l]) ++shared, in_s = k, in_t = l;
  const Vec3 &m = topology.normals[i], &n = topology.normals[j];
  if (shared >= 2) return shared > 2 || folded(m, n);
  const Corners a = shared ? starting_at(bvh.corners(i), in_s) : bvh.corners(i),
                b = shared ? starting_at(bvh.corners(j), in_t) : bvh.corners(j);
  return !on_one_side(a, m, b, shared) && !on_one_side(b, n, a, shared) && pair_meets(a, b, shared);
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

/// Around the triangles of a leaf, relative to the tree's centre and a little larger, and around all of them.
struct LeafBoxes {
  Float4 middle[3], half[3];
  float whole_middle[3], whole_half[3];
  bool crowded = true;  ///< every triangle
};

std::vector<LeafBoxes> boxes_of(const TriangleBvh& bvh, const std::vector<char>& crowded) {
  const float slack = static_cast<float>(2e-6 * bvh.radius());
  std::vector<LeafBoxes> boxes(bvh.leaves().size());
  for (std::size_t leaf = 0; leaf < boxes.size(); ++leaf) {
    LeafBoxes& b = boxes[leaf];
    Eigen::AlignedBox3d whole;
    for (int lane = 0; lane < TriangleBvh::leaf_size; ++lane) {
      const int t = bvh.leaves()[leaf].triangle[lane];
      Eigen::AlignedBox3d box;
      if (t != TriangleBvh::Node::none) {
        for (const Vec3& corner : bvh.corners(t)) box.extend(corner - bvh.centre());
        b.crowded = b.crowded && crowded[t];
        whole.extend(box);
      }
      for (int k = 0; k < 3; ++k) {
        b.middle[k][lane] = box.isEmpty() ? TriangleBvh::far_away : static_cast<float>(box.center()[k]);
        b.half[k][lane] = box.isEmpty() ? 0 : static_cast<float>(box.sizes()[k] / 2) + slack;
      }
    }
    for (int k = 0; k < 3; ++k) {
      b.whole_middle[k] = static_cast<float>(whole.center()[k]);
      b.whole_half[k] = static_cast<float>(whole.sizes()[k] / 2) + slack;
    }
  }
  return boxes;
}

/// Of four boxes those that meet the box around `middle`: lanes that are not 0.
template <class Boxes>
auto meeting(const Boxes& boxes, const float* middle, const float* half) {
  auto meet = absolute(boxes.middle[0] - splat(middle[0])) <= boxes.half[0] + splat(half[0]);
  for (int k = 1; k < 3; ++k)
    meet &= absolute(boxes.middle[k] - splat(middle[k])) <= boxes.half[k] + splat(half[k]);
  return meet;
}

/// Leaves that are to be compared with `leaf`: itself, those after it, and crowded ones.
void append_near(const TriangleBvh& bvh, const std::vector<LeafBoxes>& boxes, int leaf,
                 std::vector<int>& near) {
  const LeafBoxes& own = boxes[leaf];
  int stack[96], size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const TriangleBvh::Node& node = bvh.nodes()[stack[--size]];
    const auto meet = meeting(node, own.whole_middle, own.whole_half);
    for (int i = 0; i < 4; ++i) {
      const int child = node.child[i];
      if (!meet[i] || child == TriangleBvh::Node::none) continue;
      if (child >= 0)
        stack[size++] = child;
      else if (~child >= leaf || boxes[~child].crowded)
        near.push_back(~child);
    }
  }
}

/// test(i, j) of each pair whose boxes meet.
template <class Test>
void test_leaves(const TriangleBvh& bvh, const std::vector<LeafBoxes>& boxes, int one, int other,
                 const Test& test) {
  const auto &s = bvh.leaves()[one].triangle, &t = bvh.leaves()[other].triangle;
  const LeafBoxes& own = boxes[one];
  for (int i = 0; i < TriangleBvh::leaf_size && s[i] != TriangleBvh::Node::none; ++i) {
    const float middle[] = {own.middle[0][i], own.middle[1][i], own.middle[2][i]},
                half[] = {own.half[0][i], own.half[1][i], own.half[2][i]};
    const auto meet = meeting(boxes[other], middle, half);
    for (int j = one == other ? i + 1 : 0; j < TriangleBvh::leaf_size; ++j)
      if (meet[j]) test(s[i], t[j]);
  }
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
  std::vector<char> crossed(topology.triangles.size(), 0);
  const std::vector<char> crowded = crowded_triangles(topology);
  const std::vector<LeafBoxes> boxes = boxes_of(bvh, crowded);
  const auto test = [&](int i, int j) {
    if (crowded[i] || (j < i && !crowded[j])) std::swap(i, j);
    if ((crossed[i] && crossed[j]) || (crowded[i] && crowded[j])) return;
    if (may_meet(bvh, topology, i, j)) crossed[i] = crossed[j] = 1;
  };
  std::vector<int> near;
  for (int leaf = 0; leaf < static_cast<int>(boxes.size()); ++leaf) {
    if (leaf % leaves_a_question == 0) throw_if_cancelled("crossed_triangles");
    if (boxes[leaf].crowded) continue;
    near.clear();
    append_near(bvh, boxes, leaf, near);
    for (const int other : near) test_leaves(bvh, boxes, leaf, other, test);
  }
  return crossed;
}

}  // namespace furrow::physics
