// SPDX-License-Identifier: MIT
#include "physics/cloth/riders.h"

#include <Eigen/Geometry>
#include <optional>

namespace furrow::physics {
namespace {

/// How a triangle is turned; none without area.
std::optional<Mat3> frame_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 along = b - a, normal = along.cross(Vec3(c - a));
  if (!(normal.norm() > 0)) return std::nullopt;
  Mat3 frame;
  frame << along.normalized(), normal.normalized().cross(along.normalized()), normal.normalized();
  return frame;
}

}  // namespace

void place_riders(Cloth& cloth) {
  Particles& p = cloth.particles;
  for (const Rider& r : cloth.riders) {
    const auto [a, b, c] = r.triangle;
    const std::optional<Mat3> frame = frame_of(p.x[a], p.x[b], p.x[c]);
    if (!frame) continue;
    p.x[r.particle] =
        r.weights[0] * p.x[a] + r.weights[1] * p.x[b] + r.weights[2] * p.x[c] + *frame * r.offset;
    p.v[r.particle] = r.weights[0] * p.v[a] + r.weights[1] * p.v[b] + r.weights[2] * p.v[c];
  }
}

Rider rider_at(const Vec3& x, int particle, const std::array<int, 3>& triangle,
               const std::array<Vec3, 3>& corners, const Vec3& weights) {
  const Vec3 at = weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
  const Mat3 frame = frame_of(corners[0], corners[1], corners[2]).value();
  return {particle, triangle, weights, frame.transpose() * (x - at)};
}

}  // namespace furrow::physics
