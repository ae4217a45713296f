// SPDX-License-Identifier: MIT
#include "physics/body/compare_colliders.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>

#include "physics/base/cancel_scope.h"

namespace furrow::physics {
namespace {

void require_that(bool is_good, const char* name, double value) {
  if (!is_good)
    throw std::invalid_argument("compare_colliders: " + std::string(name) + " = " + std::to_string(value));
}

void check(const CompareOptions& o) {
  const auto is_length = [](double x) { return std::isfinite(x) && x >= 0; };
  require_that(o.points >= 2, "points", o.points);
  require_that(is_length(o.outside_margin), "outside_margin", o.outside_margin);
  require_that(is_length(o.inside_margin), "inside_margin", o.inside_margin);
  require_that(is_length(o.outside) && o.outside > o.outside_margin, "outside", o.outside);
  require_that(is_length(o.inside) && o.inside > o.inside_margin, "inside", o.inside);
  require_that(is_length(o.near) && o.near > 0, "near", o.near);
}

/// The same numbers everywhere, which those of <random>'s distributions are not; in [0, 1).
struct Unit {
  std::mt19937_64 bits;
  double operator()() { return double(bits() >> 11) * 0x1p-53; }
};

/// Points evenly over the area; every second one is moved outwards, the others inwards.
std::vector<Vec3> offset_points(const TriangleMesh& mesh, const CompareOptions& o) {
  std::vector<double> area_up_to;
  std::vector<Vec3> normals;
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 &x = mesh.vertices[std::size_t(a)], u = mesh.vertices[std::size_t(b)] - x,
               v = mesh.vertices[std::size_t(c)] - x;
    normals.push_back(u.cross(v));
    area_up_to.push_back(area += normals.back().norm());
  }
  Unit unit{std::mt19937_64(o.seed)};
  std::vector<Vec3> points;
  for (int i = 0; i < o.points; ++i) {
    const auto found = std::upper_bound(area_up_to.begin(), area_up_to.end(), unit() * area);
    const auto t = std::min(std::size_t(found - area_up_to.begin()), normals.size() - 1);
    const auto& [a, b, c] = mesh.triangles[t];
    double s = unit(), r = unit();
    if (s + r > 1) s = 1 - s, r = 1 - r;
    const double offset = unit() * (i % 2 == 0 ? o.outside : -o.inside);
    points.push_back((1 - s - r) * mesh.vertices[std::size_t(a)] + s * mesh.vertices[std::size_t(b)] +
                     r * mesh.vertices[std::size_t(c)] + offset * normals[t].normalized());
  }
  return points;
}

ErrorSpread spread(std::vector<double>& e) {
  if (e.empty()) return {};
  std::sort(e.begin(), e.end());
  const auto at = [&](double q) { return e[std::size_t(q * double(e.size() - 1))]; };
  return {at(0.5), at(0.95), at(0.99)};
}

double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

}  // namespace

ColliderComparison compare_colliders(const Collider& tested, const ExactDistance& exact,
                                     const TriangleMesh& mesh, const CompareOptions& o) {
  check(o);
  check_body(mesh, "compare_colliders");
  ColliderComparison result;
  std::vector<double> push_out, near, over, angle;
  for (int asked = 0; const Vec3& x : offset_points(mesh, o)) {
    if (asked++ % 64 == 0) throw_if_cancelled("compare_colliders");
    const SignedDistance is = exact.at(x), said = tested.at(x);
    const bool says_inside = said.value < 0;
    if (is.value > o.outside_margin) ++result.outside, result.false_inside += says_inside;
    if (is.value < -o.inside_margin) ++result.inside, result.false_outside += !says_inside;
    if (says_inside != (is.value < 0)) continue;
    const double error = said.value - is.value;
    if (!says_inside) over.push_back(std::max(error, 0.0));
    if (is.value > o.near) continue;
    (says_inside ? push_out : near).push_back(std::abs(error));
    angle.push_back(angle_between(said.gradient, is.gradient));
  }
  result.push_out = spread(push_out);
  result.near = spread(near);
  result.overestimate = spread(over);
  result.angle = spread(angle);
  return result;
}

}  // namespace furrow::physics
