// SPDX-License-Identifier: MIT
#include "physics/body/winding_number.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace furrow::physics {
namespace {

constexpr double beta = 2;

/// Half the solid angle of a triangle is the angle of this vector.
struct HalfAngle {
  double along, across;
};
HalfAngle half_angle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 p = a - x, q = b - x, r = c - x;
  const double lp = p.norm(), lq = q.norm(), lr = r.norm();
  return {lp * lq * lr + p.dot(q) * lr + q.dot(r) * lp + r.dot(p) * lq, p.dot(q.cross(r))};
}

/// Adds angles as one turns a vector, with an arc tangent at the end alone: it counts how often the vector
/// passes the negative axis.
class AngleSum {
 public:
  void add(const HalfAngle& t) {
    if (t.across == 0) return;
    const double along = along_ * t.along - across_ * t.across;
    const double across = along_ * t.across + across_ * t.along + 0.0;  // never -0
    if (across_ >= 0 && t.across > 0 && across < 0) ++turns_;
    if (across_ < 0 && t.across < 0 && across >= 0) --turns_;
    along_ = along, across_ = across;
  }
  /// Once a few were added, before the vector's length leaves the range of numbers. False: it did.
  bool shorten() {
    const double length = std::abs(along_) + std::abs(across_);
    if (!(length > 1e-280 && length < 1e280)) return false;
    along_ /= length, across_ /= length;
    return true;
  }
  double turns() const { return turns_ + std::atan2(across_, along_) / (2 * std::numbers::pi); }

 private:
  double along_ = 1, across_ = 0;
  int turns_ = 0;
};

/// The triangles of a leaf; what they turn the sum by that does not fit into it is returned.
double add_leaf(const TriangleBvh& bvh, const Vec3& x, int leaf, AngleSum& sum) {
  const AngleSum before = sum;
  const auto& triangles = bvh.leaves()[leaf].triangle;
  for (int t : triangles) {
    if (t == TriangleBvh::Node::none) continue;
    const auto& [a, b, c] = bvh.corners(t);
    sum.add(half_angle(x, a, b, c));
  }
  if (sum.shorten()) return 0;
  sum = before;
  double w = 0;
  for (int t : triangles) {
    if (t == TriangleBvh::Node::none) continue;
    const auto& [a, b, c] = bvh.corners(t);
    w += winding_of_triangle(x, a, b, c);
  }
  return w;
}

}  // namespace

double winding_of_triangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
  const HalfAngle t = half_angle(x, a, b, c);
  return t.across == 0 ? 0 : std::atan2(t.across, t.along) / (2 * std::numbers::pi);
}

WindingNumber::WindingNumber(const TriangleBvh& bvh) : bvh_(bvh), dipoles_(4 * bvh.nodes().size()) {
  const auto nodes = bvh.nodes();
  for (std::size_t i = nodes.size(); i-- > 0;)
    for (int lane = 0; lane < 4; ++lane) {
      const int child = nodes[i].child[lane];
      if (child != TriangleBvh::Node::none)
        dipoles_[4 * i + lane] = child < 0 ? of_leaf(~child) : of_node(child);
    }
}

WindingNumber::Dipole WindingNumber::of_leaf(int leaf) const {
  Dipole sum{Vec3::Zero(), Vec3::Zero(), 0, 0};
  Eigen::AlignedBox3d box;
  for (int t : bvh_.leaves()[leaf].triangle) {
    if (t == TriangleBvh::Node::none) continue;
    const auto& [a, b, c] = bvh_.corners(t);
    const Vec3 area = (b - a).cross(c - a) / 2;
    sum.area_vector += area;
    sum.area += area.norm();
    sum.centre += area.norm() * (a + b + c) / 3;
    for (const Vec3& corner : {a, b, c}) box.extend(corner);
  }
  sum.centre = sum.area > 0 ? Vec3(sum.centre / sum.area) : box.center();
  for (int t : bvh_.leaves()[leaf].triangle)
    if (t != TriangleBvh::Node::none)
      for (const Vec3& corner : bvh_.corners(t))
        sum.radius = std::max(sum.radius, (corner - sum.centre).norm());
  return sum;
}

WindingNumber::Dipole WindingNumber::of_node(int node) const {
  Dipole sum{Vec3::Zero(), Vec3::Zero(), 0, 0};
  const Dipole* parts = &dipoles_[4 * node];
  for (int i = 0; i < 4; ++i) {
    sum.area_vector += parts[i].area_vector;
    sum.area += parts[i].area;
    if (parts[i].area > 0) sum.centre += parts[i].area * parts[i].centre;
  }
  sum.centre = sum.area > 0 ? Vec3(sum.centre / sum.area) : parts[0].centre;
  for (int i = 0; i < 4; ++i)
    if (bvh_.nodes()[node].child[i] != TriangleBvh::Node::none)
      sum.radius = std::max(sum.radius, (parts[i].centre - sum.centre).norm() + parts[i].radius);
  return sum;
}

double WindingNumber::at(const Vec3& x, std::int64_t* summed) const {
  double w = 0;
  std::int64_t leaves = 0;
  AngleSum near;
  int stack[96], size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const int node = stack[--size];
    for (int i = 0; i < 4; ++i) {
      const int child = bvh_.nodes()[node].child[i];
      if (child == TriangleBvh::Node::none) continue;
      const Dipole& d = dipoles_[4 * node + i];
      const Vec3 r = d.centre - x;
      const double distance2 = r.squaredNorm();
      if (distance2 > beta * beta * d.radius * d.radius) {
        w += d.area_vector.dot(r) / (4 * std::numbers::pi * distance2 * std::sqrt(distance2));
      } else if (child >= 0) {
        stack[size++] = child;
      } else {
        w += add_leaf(bvh_, x, ~child, near);
        ++leaves;
      }
    }
  }
  if (summed != nullptr) *summed += leaves * TriangleBvh::leaf_size;
  return w + near.turns();
}

}  // namespace furrow::physics
