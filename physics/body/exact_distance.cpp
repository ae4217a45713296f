// SPDX-License-Identifier: MIT
#include "physics/body/exact_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "physics/body/surface_sides.h"

namespace furrow::physics {

struct ExactDistance::Parts {
  explicit Parts(const TriangleMesh& mesh) : bvh(mesh), sides(mesh, bvh), diagonal(bounding_diagonal(mesh)) {
    bvh.drop(sides.dropped());
    low = high = mesh.vertices[mesh.triangles[0][0]];
    for (const auto& t : mesh.triangles)
      for (int v : t) {
        low = low.cwiseMin(mesh.vertices[v]);
        high = high.cwiseMax(mesh.vertices[v]);
      }
  }

  TriangleBvh bvh;
  SurfaceSides sides;
  double diagonal;
  Vec3 low, high;
};

ExactDistance::ExactDistance(const TriangleMesh& mesh) {
  check_body(mesh, "ExactDistance");
  parts_ = std::make_shared<const Parts>(mesh);
}

SignedDistance ExactDistance::at(const Vec3& x) const {
  const ClosestPoint q = parts_->bvh.closest(x);
  const double d = std::sqrt(q.squared_distance);
  const double sign = parts_->sides.inside(x, q) ? -1 : 1;
  if (d > 1e-12 * parts_->diagonal) return {sign * d, sign / d * (x - q.point)};
  return {sign * d, pseudonormal(parts_->sides.topology(), q.triangle, q.feature).normalized()};
}

ExactDistance::Sample ExactDistance::sample(const Vec3& x) const {
  const ClosestPoint q = parts_->bvh.closest(x);
  const double d = std::sqrt(q.squared_distance);
  return {parts_->sides.inside(x, q) ? -d : d, q.triangle};
}

ExactDistance::Sample ExactDistance::sample(const Vec3& x, const Vec3& y, const Sample& at_y) const {
  return sample(x, y, at_y, [](double) { return std::nullopt; });
}

ExactDistance::Sample ExactDistance::sample(const Vec3& x, const Vec3& y, const Sample& at_y,
                                            const std::function<std::optional<bool>(double)>& beside) const {
  const ClosestPoint q = parts_->bvh.closest(x, at_y.triangle);
  const double d = std::sqrt(q.squared_distance);
  const auto inside = [&] {
    if (parts_->sides.is_cheap(q.triangle)) return parts_->sides.inside(x, q);
    if ((x - y).norm() < std::max(d, std::abs(at_y.value)) * (1 - 1e-9)) return at_y.value < 0;
    // Near holes the side changes away from the surface, too: there, the others are not asked.
    const std::optional<bool> told = parts_->sides.report().closed ? beside(d) : std::nullopt;
    return told ? *told : parts_->sides.inside(x, q);
  };
  return {inside() ? -d : d, q.triangle};
}

ClosestPoint ExactDistance::closest(const Vec3& x) const { return parts_->bvh.closest(x); }
ClosestPoint ExactDistance::closest(const Vec3& x, int guess) const { return parts_->bvh.closest(x, guess); }
double ExactDistance::winding_number(const Vec3& x) const { return parts_->sides.winding_number(x); }
const SignReport& ExactDistance::report() const { return parts_->sides.report(); }
double ExactDistance::diagonal() const { return parts_->diagonal; }
const Vec3& ExactDistance::low() const { return parts_->low; }
const Vec3& ExactDistance::high() const { return parts_->high; }

Penetration penetration(const Collider& body, std::span<const Vec3> points) {
  Penetration result;
  for (const Vec3& x : points) {
    const double d = body.at(x).value;
    if (!(d < 0)) continue;
    ++result.inside;
    result.deepest = std::max(result.deepest, -d);
  }
  return result;
}

}  // namespace furrow::physics
