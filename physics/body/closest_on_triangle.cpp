// SPDX-License-Identifier: MIT
#include "physics/body/closest_on_triangle.h"

#include <algorithm>

namespace furrow::physics {
namespace {

PointOnTriangle on_segment(const Vec3& x, const Vec3& a, const Vec3& b, Feature at_a, Feature at_b,
                           Feature between) {
  const Vec3 ab = b - a;
  const double along = ab.dot(x - a), length2 = ab.squaredNorm();
  if (along <= 0 || length2 == 0) return {a, at_a};
  if (along >= length2) return {b, at_b};
  return {a + (along / length2) * ab, between};
}

PointOnTriangle on_edges(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
  const PointOnTriangle candidates[] = {
      on_segment(x, a, b, Feature::corner0, Feature::corner1, Feature::edge01),
      on_segment(x, b, c, Feature::corner1, Feature::corner2, Feature::edge12),
      on_segment(x, c, a, Feature::corner2, Feature::corner0, Feature::edge20)};
  return *std::min_element(std::begin(candidates), std::end(candidates), [&](const auto& p, const auto& q) {
    return (x - p.point).squaredNorm() < (x - q.point).squaredNorm();
  });
}

}  // namespace

PointOnTriangle closest_on_triangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ax = x - a;
  const double d1 = ab.dot(ax), d2 = ac.dot(ax);
  if (d1 <= 0 && d2 <= 0) return {a, Feature::corner0};
  const Vec3 bx = x - b;
  const double d3 = ab.dot(bx), d4 = ac.dot(bx);
  if (d3 >= 0 && d4 <= d3) return {b, Feature::corner1};
  const double vc = d1 * d4 - d3 * d2;
  const Vec3 cx = x - c;
  const double d5 = ab.dot(cx), d6 = ac.dot(cx);
  if (d6 >= 0 && d5 <= d6) return {c, Feature::corner2};
  const double vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  const double sum = va + vb + vc;
  if (!(sum > 1e-14 * ab.squaredNorm() * ac.squaredNorm())) return on_edges(x, a, b, c);
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {a + (d1 / (d1 - d3)) * ab, Feature::edge01};
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {a + (d2 / (d2 - d6)) * ac, Feature::edge20};
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return {b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b), Feature::edge12};
  return {a + (vb / sum) * ab + (vc / sum) * ac, Feature::face};
}

}  // namespace furrow::physics
