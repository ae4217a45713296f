// SPDX-License-Identifier: MIT
#include "physics/pairs/layer_order.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>

#include "physics/body/triangle_bvh.h"

namespace furrow::physics {
namespace {

constexpr double least_sine = 0.2;

/// By vertex: one of its edges belongs to one triangle alone.
std::vector<char> vertices_at_border(const TriangleMesh& mesh) {
  std::map<std::array<int, 2>, int> uses;
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = t[i], b = t[(i + 1) % 3];
      ++uses[{std::min(a, b), std::max(a, b)}];
    }
  std::vector<char> border(mesh.vertices.size(), 0);
  for (const auto& [edge, count] : uses)
    if (count == 1)
      for (const int v : edge) border[std::size_t(v)] = 1;
  return border;
}

/// Whether a closest point lies on the border: at one of its corners, or on an edge between two of them.
bool is_at_border(const ClosestPoint& point, const std::array<int, 3>& t, const std::vector<char>& border) {
  const auto at = [&](std::size_t i) { return border[std::size_t(t[i])] != 0; };
  switch (point.feature) {
    case Feature::face:
      return false;
    case Feature::edge01:
      return at(0) && at(1);
    case Feature::edge12:
      return at(1) && at(2);
    case Feature::edge20:
      return at(2) && at(0);
    case Feature::corner0:
      return at(0);
    case Feature::corner1:
      return at(1);
    default:
      return at(2);
  }
}

}  // namespace

LayerOrder layer_order(std::span<const Vec3> outer, const TriangleMesh& inner, bool turned, double reach) {
  check_body(inner, "layer_order");
  const TriangleBvh tree(inner);
  const std::vector<char> border = vertices_at_border(inner);
  std::vector<Vec3> normal = vertex_normals(inner.triangles, inner.vertices);
  if (turned)
    for (Vec3& n : normal) n = -n;
  LayerOrder order;
  for (const Vec3& x : outer) {
    const ClosestPoint near = tree.closest(x);
    if (!(near.squared_distance < reach * reach) || near.squared_distance == 0) continue;
    const auto& t = inner.triangles[std::size_t(near.triangle)];
    Vec3 n = Vec3::Zero();
    for (const int v : t) n += normal[std::size_t(v)].normalized();
    const double up = (x - near.point).dot(n.normalized()) / std::sqrt(near.squared_distance);
    if (is_at_border(near, t, border) || !(std::abs(up) > least_sine)) continue;
    ++order.compared;
    order.outside += up > 0;
  }
  return order;
}

}  // namespace furrow::physics
