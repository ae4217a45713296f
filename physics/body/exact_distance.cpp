// SPDX-License-Identifier: MIT
#include "physics/body/exact_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "physics/body/surface_sides.h"

namespace furrow::physics {

namespace {

constexpr double loose = 2;  // times the boxes' surface: a search would take about so much longer

/// `bvh` is any tree whose memory serves the answer.
TriangleBvh moved_tree(const TriangleBvh& model, const TriangleMesh& mesh, TriangleBvh bvh) {
  bvh = model;
  bvh.move(mesh);
  return bvh.surface_of_boxes() > loose * model.surface_of_boxes() ? TriangleBvh(mesh) : std::move(bvh);
}

SurfaceTopology moved_topology(const SurfaceTopology& model, const TriangleMesh& mesh, SurfaceTopology t) {
  t = model;
  move_vertices(t, mesh);
  return t;
}

}  // namespace

struct ExactDistance::Parts {
  explicit Parts(const TriangleMesh& mesh) : bvh(mesh), sides(mesh, bvh, surface_topology(mesh)) {
    finish(mesh);
  }
  /// The model's tree and topology with other positions, in the memory of others that are over.
  Parts(const Parts& model, const TriangleMesh& mesh, TriangleBvh old_tree, SurfaceTopology old_topology)
      : bvh(moved_tree(model.bvh, mesh, std::move(old_tree))),
        sides(mesh, bvh, moved_topology(model.sides.topology(), mesh, std::move(old_topology)),
              SignTest::short_one) {
    finish(mesh);
  }
  SignedDistance at(const Vec3& x, const ClosestPoint& q) const;
  void finish(const TriangleMesh& mesh) {
    if (sides.report().dropped_triangles > 0) bvh.drop(sides.dropped());
    diagonal = bounding_diagonal(mesh);
    low = high = mesh.vertices[mesh.triangles[0][0]];
    for (const auto& t : mesh.triangles)
      for (int v : t) {
        low = low.cwiseMin(mesh.vertices[v]);
        high = high.cwiseMax(mesh.vertices[v]);
      }
  }

  TriangleBvh bvh;
  SurfaceSides sides;
  double diagonal = 0;
  Vec3 low, high;
};

ExactDistance::ExactDistance(const TriangleMesh& mesh) {
  check_body(mesh, "ExactDistance");
  parts_ = std::make_shared<Parts>(mesh);
}

ExactDistance::ExactDistance(std::shared_ptr<Parts> parts) : parts_(std::move(parts)) {}

ExactDistance ExactDistance::moved(const TriangleMesh& mesh, std::optional<ExactDistance> over) const {
  check_body(mesh, "ExactDistance");
  const auto triangles = parts_->sides.topology().triangles.size();
  if (mesh.triangles.size() != triangles)
    throw std::invalid_argument("ExactDistance::moved: " + std::to_string(mesh.triangles.size()) +
                                " triangles instead of " + std::to_string(triangles));
  const bool unused = over && over->parts_.use_count() == 1;
  return ExactDistance(
      std::make_shared<Parts>(*parts_, mesh, unused ? std::move(over->parts_->bvh) : parts_->bvh,
                              unused ? std::move(over->parts_->sides).topology() : parts_->sides.topology()));
}

SignedDistance ExactDistance::at(const Vec3& x) const { return parts_->at(x, parts_->bvh.closest(x)); }
SignedDistance ExactDistance::at(const Vec3& x, int guess) const {
  return parts_->at(x, parts_->bvh.closest(x, guess));
}

SignedDistance ExactDistance::Parts::at(const Vec3& x, const ClosestPoint& q) const {
  const double d = std::sqrt(q.squared_distance);
  const double sign = sides.inside(x, q) ? -1 : 1;
  if (d > 1e-12 * diagonal) return {sign * d, sign / d * (x - q.point)};
  return {sign * d, pseudonormal(sides.topology(), q.triangle, q.feature).normalized()};
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
