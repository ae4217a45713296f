// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <cmath>
#include <complex>

#include "geometry/mesh/warp_map.h"

/// A face's plane, for warp_directions and spread_warp alone.
namespace furrow::geometry {

/// Columns: from the source of a halfedge of the face to its target, and to the corner opposite [m].
using FaceSides = Eigen::Matrix<double, 3, 2>;

inline FaceSides sides_now(const Mesh& mesh, Halfedge h) {
  const Point& a = mesh.point(mesh.source(h));
  const Vector b = mesh.point(mesh.target(h)) - a, c = mesh.point(mesh.target(mesh.next(h))) - a;
  FaceSides sides;
  sides << b.x(), c.x(), b.y(), c.y(), b.z(), c.z();
  return sides;
}

/// Before lines, pose and motion; where that is not known, now.
inline FaceSides sides_as_made(const Mesh& mesh, Halfedge h) {
  const auto map = find_map(mesh, attribute::rest_position);
  if (!map) return sides_now(mesh, h);
  const auto at = [&](Vertex v) { return Eigen::Vector3d((*map)[v][0], (*map)[v][1], (*map)[v][2]); };
  const Eigen::Vector3d a = at(mesh.source(h)), b = at(mesh.target(h)), c = at(mesh.target(mesh.next(h)));
  FaceSides sides;
  sides << b - a, c - a;
  return sides.allFinite() ? sides : sides_now(mesh, h);
}

/// Weights of the two sides whose sum is the projection of `along` on the face; NaN where the face has no
/// area or `along` is normal to it.
inline Eigen::Vector2d weights_along(const FaceSides& sides, const Eigen::Vector3d& along) {
  const Eigen::Matrix2d g = sides.transpose() * sides;
  const Eigen::Vector2d r = sides.transpose() * along, none(NAN, NAN);
  const double determinant = g(0, 0) * g(1, 1) - g(0, 1) * g(0, 1);
  if (!(determinant > 1e-20 * g(0, 0) * g(1, 1))) return none;
  const Eigen::Vector2d a(g(1, 1) * r[0] - g(0, 1) * r[1], g(0, 0) * r[1] - g(0, 1) * r[0]);
  const Eigen::Vector2d w = a / determinant;
  return w.dot(r) > 1e-8 * along.squaredNorm() ? w : none;
}

/// A vector of the face's plane as a number, the first side along 1, counter-clockwise.
inline std::complex<double> in_plane(const FaceSides& sides, const Eigen::Vector3d& v) {
  const Eigen::Vector3d x = sides.col(0).normalized(),
                        y = sides.col(0).cross(sides.col(1)).cross(x).normalized();
  return {v.dot(x), v.dot(y)};
}
inline Eigen::Vector3d in_space(const FaceSides& sides, double angle) {
  const Eigen::Vector3d x = sides.col(0).normalized(),
                        y = sides.col(0).cross(sides.col(1)).cross(x).normalized();
  return std::cos(angle) * x + std::sin(angle) * y;
}

}  // namespace furrow::geometry
