// SPDX-License-Identifier: MIT
#include "physics/pairs/pair_distance.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace furrow::physics {
namespace {

constexpr double least_area = 1e-14;  // of a triangle, squared, over that of its sides
constexpr double parallel = 1e-14;    // squared sine at which only ends count
constexpr double doubtful = 1e-6;     // squared sine below which ends are compared with the inside

/// Parameter of the point of the segment from a along ab that is next to x.
double along(const Vec3& x, const Vec3& a, const Vec3& ab) {
  const double length2 = ab.squaredNorm();
  return length2 > 0 ? std::clamp(ab.dot(x - a) / length2, 0.0, 1.0) : 0.0;
}

/// At the point with the barycentrics (1 - v - w, v, w).
PairDistance at_point(const Vec3& ax, const Vec3& ab, const Vec3& ac, double v, double w) {
  return {ax - v * ab - w * ac, {1, -(1 - v - w), -v, -w}};
}

const PairDistance& nearer(const PairDistance& a, const PairDistance& b) {
  return b.squared() < a.squared() ? b : a;
}

PairDistance on_border(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ax = x - a, ab = b - a, ac = c - a;
  const double bc = along(x, b, c - b);
  const PairDistance first = at_point(ax, ab, ac, along(x, a, ab), 0),
                     second = at_point(ax, ab, ac, 1 - bc, bc),
                     third = at_point(ax, ab, ac, 0, along(x, a, ac));
  return nearer(nearer(first, second), third);
}

PairDistance between(const Vec3& ba, const Vec3& e, const Vec3& f, double s, double t) {
  return {ba + s * e - t * f, {1 - s, s, -(1 - t), -t}};
}

/// The nearest pair of points of which one is an end.
PairDistance at_ends(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1) {
  const Vec3 ba = a0 - b0, e = a1 - a0, f = b1 - b0;
  const std::array<double, 4> s = {0, 1, along(b0, a0, e), along(b1, a0, e)},
                              t = {along(a0, b0, f), along(a1, b0, f), 0, 1};
  std::array<double, 4> squared;
  for (std::size_t i = 0; i < 4; ++i) squared[i] = Vec3(ba + s[i] * e - t[i] * f).squaredNorm();
  const std::size_t a = squared[1] < squared[0] ? 1 : 0, b = squared[3] < squared[2] ? 3 : 2;
  const std::size_t best = squared[b] < squared[a] ? b : a;
  return between(ba, e, f, s[best], t[best]);
}

}  // namespace

PairDistance vertex_triangle_distance(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ax = x - a;
  const double d1 = ab.dot(ax), d2 = ac.dot(ax);
  if (d1 <= 0 && d2 <= 0) return at_point(ax, ab, ac, 0, 0);
  const Vec3 bx = x - b;
  const double d3 = ab.dot(bx), d4 = ac.dot(bx);
  if (d3 >= 0 && d4 <= d3) return at_point(ax, ab, ac, 1, 0);
  const Vec3 cx = x - c;
  const double d5 = ab.dot(cx), d6 = ac.dot(cx);
  if (d6 >= 0 && d5 <= d6) return at_point(ax, ab, ac, 0, 1);
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  const double sum = va + vb + vc;
  if (!(sum > least_area * ab.squaredNorm() * ac.squaredNorm())) return on_border(x, a, b, c);
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return at_point(ax, ab, ac, d1 / (d1 - d3), 0);
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return at_point(ax, ab, ac, 0, d2 / (d2 - d6));
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return at_point(ax, ab, ac, 1 - w, w);
  }
  return at_point(ax, ab, ac, vb / sum, vc / sum);
}

/// The nearest points lie inside both segments, or one of them is an end.
PairDistance edge_edge_distance(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1) {
  const Vec3 ba = a0 - b0, e = a1 - a0, f = b1 - b0;
  const double ee = e.squaredNorm(), ff = f.squaredNorm(), ef = e.dot(f), ed = e.dot(ba), fd = f.dot(ba);
  const double sine2 = ee * ff - ef * ef;
  if (!(sine2 > parallel * ee * ff)) return at_ends(a0, a1, b0, b1);
  const double s = (ef * fd - ed * ff) / sine2, t = (ee * fd - ef * ed) / sine2;
  if (!(s > 0 && s < 1 && t > 0 && t < 1)) return at_ends(a0, a1, b0, b1);
  const PairDistance inside = between(ba, e, f, s, t);
  return sine2 > doubtful * ee * ff ? inside : nearer(inside, at_ends(a0, a1, b0, b1));
}

}  // namespace furrow::physics
