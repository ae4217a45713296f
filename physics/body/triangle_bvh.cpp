// SPDX-License-Identifier: MIT
#include "physics/body/triangle_bvh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace furrow::physics {
namespace {

constexpr int leaf_size = TriangleBvh::leaf_size;
constexpr float far_away = TriangleBvh::far_away;

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
}

void TriangleBvh::drop(std::span<const char> dropped) {
  const auto kept = std::find(dropped.begin(), dropped.end(), 0);
  if (dropped.size() != slot_of_.size() || kept == dropped.end())
    throw std::invalid_argument("TriangleBvh::drop: needs one entry a triangle, and one of them kept");
  first_kept_ = static_cast<int>(kept - dropped.begin());
  refit(dropped);
}

}  // namespace furrow::physics
