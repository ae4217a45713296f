// SPDX-License-Identifier: MIT
#include "physics/triangle_bvh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace furrow::physics {
namespace {

constexpr float far_away = 1e15f;  // its square is a finite float
constexpr int leaf_size = 4;

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
    const Float4 d = max(max(node.low[k] - p[k], p[k] - node.high[k]), splat(0));
    sum += d * d;
  }
  return sum;
}

Float4 square(const Float4* r) { return r[0] * r[0] + r[1] * r[1] + r[2] * r[2]; }

/// Squares of the distances from p to the four triangles: the least over the edges and, above the face, the plane.
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
  const Float4 rest = leaf.g11 * leaf.g22 - leaf.g12 * leaf.g12 - v - w;
  return min(min(v, w), rest) >= splat(0) ? min(edges, height * height) : edges;
}

/// No triangle whose float distance is above this can be closer than best2: float moves a point by < slack.
float search_limit(double best2, double slack) {
  const double d = std::sqrt(best2) + slack;
  return static_cast<float>(std::min(d * d * 1.00001, 1e37));
}

}  // namespace

TriangleBvh::TriangleBvh(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  std::vector<Vec3> centroids;
  centroids.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    centroids.push_back((mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3);
    for (int v : t) box.extend(mesh.vertices[v]);
  }
  centre_ = box.center();
  radius_ = box.sizes().maxCoeff() / 2;
  std::vector<int> order(mesh.triangles.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  slot_of_.resize(order.size());
  build(centroids, mesh, order, 0, static_cast<int>(order.size()));
  refit(std::vector<char>(order.size(), 0));
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
    const int child = size == 0            ? Node::none
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
        nodes_[i].low[k][lane] = box.isEmpty() ? far_away : static_cast<float>(box.min()[k] - centre_[k]);
        nodes_[i].high[k][lane] = box.isEmpty() ? far_away : static_cast<float>(box.max()[k] - centre_[k]);
      }
      node_box[i].extend(box);
    }
}

void TriangleBvh::drop(std::span<const char> dropped) {
  const auto kept = std::find(dropped.begin(), dropped.end(), 0);
  if (dropped.size() != slot_of_.size() || kept == dropped.end())
    throw std::invalid_argument("TriangleBvh::drop: needs one entry a triangle, and one of them kept");
  first_kept_ = static_cast<int>(kept - dropped.begin());
  refit(dropped);
}

void TriangleBvh::search_leaf(int index, const Vec3& x, const Float4* p, double slack, float& limit,
                              ClosestPoint& best) const {
  const Leaf& leaf = leaves_[index];
  const Float4 d = triangle_distances(leaf, p);
  for (int lane = 0; lane < leaf_size; ++lane) {
    if (!(d[lane] <= limit) || leaf.triangle[lane] == best.triangle) continue;
    const auto& [a, b, c] = corners_[leaf_size * index + lane];
    const PointOnTriangle q = closest_on_triangle(x, a, b, c);
    const double squared = (x - q.point).squaredNorm();
    if (squared >= best.squared_distance) continue;
    best = {squared, q.point, leaf.triangle[lane], q.feature};
    limit = search_limit(squared, slack);
  }
}

ClosestPoint TriangleBvh::closest(const Vec3& x, int guess) const {
  const auto& [a, b, c] = corners(guess);
  const PointOnTriangle q = closest_on_triangle(x, a, b, c);
  ClosestPoint best{(x - q.point).squaredNorm(), q.point, guess, q.feature};
  const Vec3 local = x - centre_;
  if (!(local.cwiseAbs().maxCoeff() < 1e12)) return best;  // also NaN: float boxes say nothing there
  const double slack = 1e-6 * (radius_ + local.cwiseAbs().maxCoeff());
  float limit = search_limit(best.squared_distance, slack);
  const Float4 p[] = {splat(static_cast<float>(local[0])), splat(static_cast<float>(local[1])),
                      splat(static_cast<float>(local[2]))};
  struct Entry {
    float distance;
    int child;
  } stack[96];
  int size = 0;
  stack[size++] = {0, 0};
  while (size > 0) {
    const Entry top = stack[--size];
    if (top.distance > limit) continue;
    if (top.child < 0) {
      search_leaf(~top.child, x, p, slack, limit, best);
      continue;
    }
    const Node& node = nodes_[top.child];
    const Float4 d = box_distances(node, p);
    const int base = size;
    for (int i = 0; i < 4; ++i) {
      if (!(d[i] <= limit) || node.child[i] == Node::none) continue;
      int at = size++;  // the nearest child ends on top
      for (; at > base && stack[at - 1].distance < d[i]; --at) stack[at] = stack[at - 1];
      stack[at] = {d[i], node.child[i]};
    }
  }
  return best;
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
        meets = meets && node.low[k][i] <= to[k] + slack && node.high[k][i] >= from[k] - slack;
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
