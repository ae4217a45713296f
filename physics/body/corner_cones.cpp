// SPDX-License-Identifier: MIT
#include "physics/body/corner_cones.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace furrow::physics {
namespace {

bool comes_first(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

/// One of 65,536 classes, the same for the same place.
std::size_t class_of(const Vec3& place) {
  std::uint64_t sum = 0;
  for (const double c : place) {
    const double plain = c + 0.0;  // never -0
    std::uint64_t bits;
    std::memcpy(&bits, &plain, sizeof bits);
    sum = (sum ^ bits) * 0x9e3779b97f4a7c15ull;
    sum ^= sum >> 29;
  }
  return sum >> 48;
}

}  // namespace

CrowdedCorners::CrowdedCorners(const TriangleMesh& mesh) {
  std::vector<int> uses(mesh.vertices.size(), 0), in_class(1 << 16, 0);
  for (const auto& t : mesh.triangles)
    for (const int v : t) ++uses[v];
  for (std::size_t v = 0; v < uses.size(); ++v)
    if (uses[v]) in_class[class_of(mesh.vertices[v])] += uses[v];
  if (*std::max_element(in_class.begin(), in_class.end()) < crowd) return;
  std::vector<int> maybe;
  for (std::size_t v = 0; v < uses.size(); ++v)
    if (uses[v] && in_class[class_of(mesh.vertices[v])] >= crowd) maybe.push_back(static_cast<int>(v));
  const auto at = [&](int v) -> const Vec3& { return mesh.vertices[v]; };
  std::sort(maybe.begin(), maybe.end(), [&](int v, int w) { return comes_first(at(v), at(w)); });
  for (std::size_t i = 0, j = 0; i < maybe.size(); i = j) {
    int here = 0;
    for (; j < maybe.size() && at(maybe[j]) == at(maybe[i]); ++j) here += uses[maybe[j]];
    if (here >= crowd) places_.push_back(at(maybe[i]));
  }
}

std::vector<CrowdedCorner> CrowdedCorners::of(int triangle, const std::array<Vec3, 3>& corners) const {
  std::vector<CrowdedCorner> crowded;
  for (int k = 0; k < 3; ++k) {
    const auto found = std::lower_bound(places_.begin(), places_.end(), corners[k], comes_first);
    if (found != places_.end() && *found == corners[k])
      crowded.push_back({static_cast<int>(found - places_.begin()), {triangle, k}});
  }
  return crowded;
}

std::vector<CrowdedCorner> common_corners(std::span<const CrowdedCorner> a,
                                          std::span<const CrowdedCorner> b) {
  std::vector<CrowdedCorner> common;
  for (const CrowdedCorner& c : a)
    if (std::any_of(b.begin(), b.end(), [&](const CrowdedCorner& d) { return d.place == c.place; }))
      common.push_back(c);
  return common;
}

CornerCone fit_corner_cone(const Vec3& apex, std::span<const Vec3> points) {
  constexpr double widest = 1.4;     // [rad] a wider cone would tell nothing apart
  constexpr double rounding = 1e-6;  // [rad] of the cone in float
  const CornerCone all{apex, Vec3::Zero(), 0, 0};
  Vec3 sum = Vec3::Zero();
  for (const Vec3& x : points)
    if (const double far = (x - apex).norm(); far > 0) sum += (x - apex) / far;
  if (!(sum.norm() > 1e-9)) return all;
  const Vec3 axis = sum.normalized();
  double angle = 0;
  for (const Vec3& x : points)
    if (x != apex) angle = std::max(angle, std::atan2((x - apex).cross(axis).norm(), (x - apex).dot(axis)));
  angle += rounding;
  if (!(angle < widest)) return all;
  return {apex, axis, std::cos(angle), std::sin(angle)};
}

CornerCones::CornerCones() : cosine(splat(0)), sine(splat(0)) {
  for (int k = 0; k < 3; ++k) apex[k] = axis[k] = splat(0);
}

void CornerCones::set(int lane, const CornerCone& cone, TriangleCorner corner) {
  for (int k = 0; k < 3; ++k) {
    apex[k][lane] = static_cast<float>(cone.apex[k]);
    axis[k][lane] = static_cast<float>(cone.axis[k]);
  }
  cosine[lane] = static_cast<float>(cone.cosine);
  sine[lane] = static_cast<float>(cone.sine);
  at[lane] = corner;
}

}  // namespace furrow::physics
