// SPDX-License-Identifier: MIT
#include "physics/body/triangle_bvh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace furrow::physics {
namespace {

constexpr int leaf_size = TriangleBvh::leaf_size;

/// Left part of a range of n triangles: about half, in whole leaves.
int left_part(int n) { return ((n / 2 + leaf_size - 1) / leaf_size) * leaf_size; }

int split(const std::vector<Vec3>& centroids, std::vector<int>& order, int begin, int end) {
  if (end - begin <= leaf_size) return end;
  Eigen::AlignedBox3d box;
  for (int i = begin; i < end; ++i) box.extend(centroids[order[i]]);
  int axis;
  box.sizes().maxCoeff(&axis);
  const int middle = begin + left_part(end - begin);
  std::nth_element(order.begin() + begin, order.begin() + middle, order.begin() + end, [&](int s, int t) {
    const double cs = centroids[s][axis], ct = centroids[t][axis];
    return cs < ct || (cs == ct && s < t);
  });
  return middle;
}

/// Squares of the distances from p to the four boxes.
Float4 box_distances(const TriangleBvh::Node& node, const Float4* p) {
  Float4 sum = splat(0);
  for (int k = 0; k < 3; ++k) {
    const Float4 d = positive_part(absolute(p[k] - node.middle[k]) - node.half[k]);
    sum += d * d;
  }
  return sum;
}

Float4 square(const Float4* r) { return r[0] * r[0] + r[1] * r[1] + r[2] * r[2]; }

/// Squares of the distances from p to the four triangles: the least over the edges and, above the face, the
/// plane.
Float4 triangle_distances(const TriangleBvh::Leaf& leaf, const Float4* p) {
  Float4 q[3], k1 = splat(0), k2 = splat(0), height = splat(0);
  for (int k = 0; k < 3; ++k) {
    q[k] = p[k] - leaf.a[k];
    k1 += q[k] * leaf.e1[k];
    k2 += q[k] * leaf.e2[k];
    height += q[k] * leaf.n[k];
  }
  const Float4 t1 = clamp01(k1 * leaf.inverse11), t2 = clamp01(k2 * leaf.inverse22);
  const Float4 t3 = clamp01((k2 - k1 - leaf.g12 + leaf.g11) * leaf.inverse33);
  Float4 r1[3], r2[3], r3[3];
  for (int k = 0; k < 3; ++k) {
    r1[k] = q[k] - t1 * leaf.e1[k];
    r2[k] = q[k] - t2 * leaf.e2[k];
    r3[k] = (q[k] - leaf.e1[k]) - t3 * (leaf.e2[k] - leaf.e1[k]);
  }
  const Float4 edges = min(min(square(r1), square(r2)), square(r3));
  const Float4 v = leaf.g22 * k1 - leaf.g12 * k2, w = leaf.g11 * k2 - leaf.g12 * k1;
  const Float4 rest = leaf.det - v - w;
  return min(min(v, w), rest) >= splat(0) ? min(edges, height * height) : edges;
}

}  // namespace

TriangleBvh::TriangleBvh(const TriangleMesh& mesh) : crowded_(mesh) {
  std::vector<Vec3> centroids;
  centroids.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles)
    centroids.push_back((mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3);
  surround(mesh);
  std::vector<int> order(mesh.triangles.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  slot_of_.resize(order.size());
  build(centroids, mesh, order, 0, static_cast<int>(order.size()));
  refit(std::vector<char>(order.size(), 0));
}

void TriangleBvh::move(const TriangleMesh& mesh) {
  crowded_ = CrowdedCorners(mesh);
  surround(mesh);
  for (std::size_t t = 0; t < slot_of_.size(); ++t)
    for (int c = 0; c < 3; ++c) corners_[slot_of_[t]][c] = mesh.vertices[mesh.triangles[t][c]];
  first_kept_ = 0;
  refit(std::vector<char>(slot_of_.size(), 0));
}

void TriangleBvh::surround(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const auto& t : mesh.triangles)
    for (int v : t) box.extend(mesh.vertices[v]);
  centre_ = box.center();
  radius_ = box.sizes().maxCoeff() / 2;
}

double TriangleBvh::surface_of_boxes() const {
  Eigen::AlignedBox3f all;
  double sum = 0;
  for (const Node& node : nodes_)
    for (int lane = 0; lane < 4; ++lane) {
      const auto &m = node.middle, &h = node.half;
      if (!(m[0][lane] < far_away)) continue;  // nothing is in it
      const Eigen::Vector3f middle(m[0][lane], m[1][lane], m[2][lane]),
          half(h[0][lane], h[1][lane], h[2][lane]);
      if (&node == nodes_.data()) all.extend(middle - half).extend(middle + half);
      sum += half_surface(half.cast<double>());
    }
  return sum / half_surface(all.sizes().cast<double>() / 2);
}

/// Whether a quarter of the triangles are lower than a fiftieth of their longest side. Boxes along x, y and z
/// then hold next to nothing: of a fan, each reaches over a quarter of all.
bool TriangleBvh::has_needles() const {
  std::size_t needles = 0;
  for (int slot : slot_of_) {
    const auto& [a, b, c] = corners_[slot];
    const double longest2 = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    needles += (b - a).cross(c - a).norm() < 0.02 * longest2;
  }
  return 4 * needles > slot_of_.size();
}

int TriangleBvh::build(const std::vector<Vec3>& centroids, const TriangleMesh& mesh, std::vector<int>& order,
                       int begin, int end) {
  const int middle = split(centroids, order, begin, end);
  const int bounds[] = {begin, split(centroids, order, begin, middle), middle,
                        middle < end ? split(centroids, order, middle, end) : end, end};
  const int node = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  for (int i = 0; i < 4; ++i) {
    const int size = bounds[i + 1] - bounds[i];
    const int child = size == 0           ? Node::none
                      : size <= leaf_size ? ~add_leaf(mesh, order, bounds[i], bounds[i + 1])
                                          : build(centroids, mesh, order, bounds[i], bounds[i + 1]);
    nodes_[node].child[i] = child;
  }
  return node;
}

int TriangleBvh::add_leaf(const TriangleMesh& mesh, const std::vector<int>& order, int begin, int end) {
  const int leaf = static_cast<int>(leaves_.size());
  leaves_.emplace_back();
  for (int lane = 0; lane < leaf_size; ++lane) {
    const bool used = begin + lane < end;
    leaves_[leaf].triangle[lane] = used ? order[begin + lane] : Node::none;
    corners_.push_back({centre_, centre_, centre_});
    if (!used) continue;
    const int t = order[begin + lane];
    slot_of_[t] = leaf_size * leaf + lane;
    for (int c = 0; c < 3; ++c) corners_.back()[c] = mesh.vertices[mesh.triangles[t][c]];
  }
  return leaf;
}

void TriangleBvh::set_lane(int index, int lane, bool used) {
  Leaf& leaf = leaves_[index];
  const auto& [a, b, c] = corners_[leaf_size * index + lane];
  const Vec3 e1 = b - a, e2 = c - a, n = used ? Vec3(e1.cross(e2).stableNormalized()) : Vec3(0, 0, 0);
  for (int k = 0; k < 3; ++k) {
    leaf.a[k][lane] = used ? static_cast<float>(a[k] - centre_[k]) : far_away;
    leaf.e1[k][lane] = used ? static_cast<float>(e1[k]) : 0;
    leaf.e2[k][lane] = used ? static_cast<float>(e2[k]) : 0;
    leaf.n[k][lane] = static_cast<float>(n[k]);
  }
  const double area2 = e1.cross(e2).squaredNorm(), longest2 = std::max(e1.squaredNorm(), e2.squaredNorm());
  const bool flat = used && area2 > 1e-13 * longest2 * longest2;
  leaf.det[lane] = flat ? static_cast<float>(area2) : -1;
  const auto inverse = [&](double g) { return used && g > 1e-36 ? static_cast<float>(1 / g) : 0.0f; };
  leaf.g11[lane] = used ? static_cast<float>(e1.squaredNorm()) : 0;
  leaf.g12[lane] = used ? static_cast<float>(e1.dot(e2)) : 0;
  leaf.g22[lane] = used ? static_cast<float>(e2.squaredNorm()) : 0;
  leaf.inverse11[lane] = inverse(e1.squaredNorm());
  leaf.inverse22[lane] = inverse(e2.squaredNorm());
  leaf.inverse33[lane] = inverse((c - b).squaredNorm());
}

void TriangleBvh::refit(std::span<const char> dropped) {
  std::vector<Eigen::AlignedBox3d> node_box(nodes_.size());
  for (std::size_t i = nodes_.size(); i-- > 0;)
    for (int lane = 0; lane < 4; ++lane) {
      const int child = nodes_[i].child[lane];
      Eigen::AlignedBox3d box;
      if (child >= 0) box = node_box[child];
      for (int j = 0; child < 0 && child != Node::none && j < leaf_size; ++j) {
        const int t = leaves_[~child].triangle[j];
        const bool used = t != Node::none && !dropped[t];
        set_lane(~child, j, used);
        if (used)
          for (const Vec3& corner : corners_[leaf_size * ~child + j]) box.extend(corner);
      }
      for (int k = 0; k < 3; ++k) {
        nodes_[i].middle[k][lane] =
            box.isEmpty() ? far_away : static_cast<float>(box.center()[k] - centre_[k]);
        nodes_[i].half[k][lane] = box.isEmpty() ? 0 : static_cast<float>(box.sizes()[k] / 2);
      }
      node_box[i].extend(box);
    }
  oriented_.clear();
  cones_.clear();
  if (has_needles()) orient(dropped);
  if (!crowded_.empty()) fit_cones(dropped);
}

/// Needs the nodes' own boxes; sets the others where they are much smaller. O(T log T).
void TriangleBvh::orient(std::span<const char> dropped) {
  constexpr double much_smaller = 0.5;  // of the surface
  oriented_.assign(nodes_.size(), {});
  std::vector<std::vector<Vec3>> points(nodes_.size());
  for (std::size_t i = nodes_.size(); i-- > 0;)
    for (int lane = 0; lane < 4; ++lane) {
      const int child = nodes_[i].child[lane];
      std::vector<Vec3> below;
      if (child >= 0) below.swap(points[child]);
      for (int j = 0; child < 0 && child != Node::none && j < leaf_size; ++j)
        if (const int t = leaves_[~child].triangle[j]; t != Node::none && !dropped[t])
          for (const Vec3& corner : corners_[leaf_size * ~child + j]) below.push_back(corner - centre_);
      if (below.empty()) continue;
      const OrientedBox box = fit_oriented_box(below);
      const auto& half = nodes_[i].half;
      const Vec3 aligned(half[0][lane], half[1][lane], half[2][lane]);
      if (half_surface(box.half) < much_smaller * half_surface(aligned)) oriented_[i].set(lane, box);
      points[i].insert(points[i].end(), below.begin(), below.end());
    }
}

/// A child has a cone where one corner is shared by all that is below it. O(T log T).
void TriangleBvh::fit_cones(std::span<const char> dropped) {
  struct Below {
    std::vector<Vec3> points;
    std::vector<CrowdedCorner> shared;
    void add(std::span<const Vec3> more, const std::vector<CrowdedCorner>& corners) {
      shared = points.empty() ? corners : common_corners(shared, corners);
      points.insert(points.end(), more.begin(), more.end());
    }
  };
  cones_.assign(nodes_.size(), {});
  std::vector<Below> nodes(nodes_.size());
  for (std::size_t i = nodes_.size(); i-- > 0;)
    for (int lane = 0; lane < 4; ++lane) {
      const int child = nodes_[i].child[lane];
      Below below;
      if (child >= 0) std::swap(below, nodes[child]);
      for (int j = 0; child < 0 && child != Node::none && j < leaf_size; ++j)
        if (const int t = leaves_[~child].triangle[j]; t != Node::none && !dropped[t])
          below.add(corners(t), crowded_.of(t, corners(t)));
      if (below.points.empty()) continue;
      if (!below.shared.empty()) {
        const TriangleCorner at = below.shared[0].at;
        CornerCone cone = fit_corner_cone(corners(at.triangle)[at.corner], below.points);
        cone.apex -= centre_;
        cones_[i].set(lane, cone, at);
      }
      nodes[i].add(below.points, below.shared);
    }
}

void TriangleBvh::drop(std::span<const char> dropped) {
  const auto kept = std::find(dropped.begin(), dropped.end(), 0);
  if (dropped.size() != slot_of_.size() || kept == dropped.end())
    throw std::invalid_argument("TriangleBvh::drop: needs one entry a triangle, and one of them kept");
  first_kept_ = static_cast<int>(kept - dropped.begin());
  refit(dropped);
}

/// Float distances are off by less than `slack`. So nothing whose float distance is above `limit` can be the
/// answer; what is below waits in `waiting` to be computed in double.
struct TriangleBvh::Search {
  struct Entry {
    float distance;  ///< squared
    int child;
  };
  struct Candidate {
    float distance;  ///< squared
    int slot;
  };
  Vec3 x;
  Float4 p[3];
  double slack;
  float limit;
  bool trust_float;  ///< a float distance may lower the limit
  ClosestPoint best;
  int size = 0, waiting_size = 0;
  std::int64_t searched = 0;  ///< leaves
  Entry stack[96];
  Candidate waiting[64];

  /// Lowers the limit when something is known to lie within `d` (slack included).
  void lower_limit(double d) {
    limit = std::min(limit, static_cast<float>(std::min((d + slack) * (d + slack) * 1.00001, 1e37)));
  }
};

void TriangleBvh::settle(Search& s) const {
  for (int i = 0; i < s.waiting_size; ++i) {
    const int slot = s.waiting[i].slot, triangle = leaves_[slot / leaf_size].triangle[slot % leaf_size];
    if (s.waiting[i].distance > s.limit || triangle == s.best.triangle) continue;
    const auto& [a, b, c] = corners_[slot];
    const PointOnTriangle q = closest_on_triangle(s.x, a, b, c);
    const double squared = (s.x - q.point).squaredNorm();
    if (squared >= s.best.squared_distance) continue;
    s.best = {squared, q.point, triangle, q.feature};
    s.lower_limit(std::sqrt(squared));
  }
  s.waiting_size = 0;
}

void TriangleBvh::search_leaf(Search& s, int leaf) const {
  ++s.searched;
  const Float4 d = triangle_distances(leaves_[leaf], s.p);
  const float nearest = least(d);
  if (!(nearest <= s.limit)) return;
  if (s.trust_float) s.lower_limit(std::sqrt(static_cast<double>(nearest)) + s.slack);
  if (s.waiting_size + leaf_size >= static_cast<int>(std::size(s.waiting))) settle(s);
  for (int lane = 0; lane < leaf_size; ++lane) {
    s.waiting[s.waiting_size] = {d[lane], leaf_size * leaf + lane};
    s.waiting_size += d[lane] <= s.limit;
  }
  if (!s.trust_float) settle(s);
}

/// Lower bounds of the distances, squared. Where a corner is closer than all else of a child it is taken for
/// the child, which need not be searched.
Float4 TriangleBvh::apart_by_cones(Search& s, const CornerCones& cones) const {
  ConeDistances d = cone_distances(cones, s.p, static_cast<float>(s.slack));
  for (int lane = 0; lane < 4; ++lane) {
    if (!(d.behind[lane] > 0)) continue;
    if (d.squared[lane] <= s.limit) {
      const TriangleCorner at = cones.at[lane];
      const Vec3& corner = corners(at.triangle)[at.corner];
      const double squared = (s.x - corner).squaredNorm();
      const auto feature = static_cast<Feature>(static_cast<int>(Feature::corner0) + at.corner);
      if (squared < s.best.squared_distance) {
        s.best = {squared, corner, at.triangle, feature};
        s.lower_limit(std::sqrt(squared));
      }
    }
    d.squared[lane] = far_away * far_away;
  }
  return d.squared;
}

void TriangleBvh::push_children(Search& s, const Node& node) const {
  Float4 d = box_distances(node, s.p);
  if (!cones_.empty()) [[unlikely]]
    d = max(d, apart_by_cones(s, cones_[static_cast<std::size_t>(&node - nodes_.data())]));
  if (!oriented_.empty()) [[unlikely]]
    d = max(d, oriented_distances(oriented_[static_cast<std::size_t>(&node - nodes_.data())], s.p,
                                  static_cast<float>(s.slack)));
  const float limit = s.limit;
  const int base = s.size;
  int size = base, nearest = base;
  float least_distance = TriangleBvh::far_away * TriangleBvh::far_away;
  for (int i = 0; i < 4; ++i) {  // no branch: which children are near is hard to foresee
    s.stack[size] = {d[i], node.child[i]};
    nearest = d[i] < least_distance ? size : nearest;
    least_distance = std::min(least_distance, d[i]);
    size += d[i] <= limit;
  }
  s.size = size;
  if (base < size) std::swap(s.stack[nearest], s.stack[size - 1]);
}

void TriangleBvh::search(Search& s) const {
  s.stack[s.size++] = {0, 0};
  while (s.size > 0) {
    const Search::Entry top = s.stack[--s.size];
    if (top.distance > s.limit) continue;
    if (top.child >= 0)
      push_children(s, nodes_[top.child]);
    else
      search_leaf(s, ~top.child);
  }
  settle(s);
}

ClosestPoint TriangleBvh::closest(const Vec3& x, int guess, std::int64_t* searched) const {
  if (!is_kept(guess)) guess = first_kept_;
  const auto& [a, b, c] = corners(guess);
  const PointOnTriangle q = closest_on_triangle(x, a, b, c);
  const Vec3 local = x - centre_;
  Search s;
  s.best = {(x - q.point).squaredNorm(), q.point, guess, q.feature};
  if (!(local.cwiseAbs().sum() < 1e12)) return s.best;  // also NaN: float boxes say nothing there
  s.x = x;
  for (int k = 0; k < 3; ++k) s.p[k] = splat(static_cast<float>(local[k]));
  s.slack = 1e-6 * (radius_ + local.cwiseAbs().maxCoeff());
  s.limit = 1e37f;
  s.lower_limit(std::sqrt(s.best.squared_distance));
  s.trust_float = true;
  search(s);
  if (searched) *searched += s.searched;
  if (s.best.squared_distance <= s.limit) return s.best;
  // a needle that float took to be nearer than it is: once more, with limits from double only
  s.limit = 1e37f;
  s.lower_limit(std::sqrt(s.best.squared_distance));
  s.trust_float = false;
  search(s);
  return s.best;
}

void TriangleBvh::append_near(const Vec3& low, const Vec3& high, std::vector<int>& triangles) const {
  const double slack = 1e-6 * radius_;
  const Vec3 from = low - centre_, to = high - centre_;
  std::vector<int> stack{0};
  while (!stack.empty()) {
    const Node& node = nodes_[stack.back()];
    stack.pop_back();
    for (int i = 0; i < 4; ++i) {
      bool meets = node.child[i] != Node::none;
      for (int k = 0; k < 3; ++k)
        meets = meets && std::abs((from[k] + to[k]) / 2 - node.middle[k][i]) <=
                             (to[k] - from[k]) / 2 + node.half[k][i] + slack;
      if (!meets) continue;
      if (node.child[i] >= 0) {
        stack.push_back(node.child[i]);
        continue;
      }
      for (int t : leaves_[~node.child[i]].triangle)
        if (t != Node::none) triangles.push_back(t);
    }
  }
}

}  // namespace furrow::physics
