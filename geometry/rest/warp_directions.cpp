// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/rest/warp_directions.h"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <complex>
#include <map>
#include <stdexcept>
#include <string>

#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/errors.h"
#include "geometry/rest/warp_frame.h"

namespace furrow::geometry {
namespace {

FaceMap<RestPosition> fresh_map(Mesh& mesh) {
  auto map = ensure_map(mesh, attribute::warp);
  for (Face f : mesh.faces()) map[f] = attribute::warp.default_value;
  return map;
}

RestPosition stored(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// Weights of the sides from the source of h whose sum is the warp; NaN where it is not known.
Eigen::Vector2d weights_of(const Mesh& mesh, Halfedge h) {
  const auto map = find_map(mesh, attribute::warp);
  const Eigen::Vector2d none(unset_value, unset_value);
  if (!map) return none;
  const RestPosition& w = (*map)[mesh.face(h)];
  return weights_along(sides_as_made(mesh, h), {w[0], w[1], w[2]});
}

}  // namespace

double warp_angle(const Mesh& mesh, Halfedge h, const std::vector<double>& rest) {
  const Eigen::Vector2d a = weights_of(mesh, h);
  const auto own = find_map(mesh, attribute::triangle_rest_length);
  const auto length = [&](Halfedge e) {
    return own && !std::isnan((*own)[e]) ? (*own)[e] : rest[mesh.edge(e).idx()];
  };
  const double ab = length(h), bc = length(mesh.next(h)), ca = length(mesh.prev(h));
  const double area = triangle_area(ab, bc, ca);
  if (!(area > 0)) return unset_value;
  const double x = (ab * ab + (ca - bc) * (ca + bc)) / (2 * ab), y = 2 * area / ab;
  return std::atan2(a[1] * y, a[0] * ab + a[1] * x);
}

double known_warp_angle(const Mesh& mesh, Halfedge h, const std::vector<double>& rest) {
  const double angle = warp_angle(mesh, h, rest);
  if (std::isnan(angle))
    throw ContentError("face " + std::to_string(mesh.face(h).idx()) +
                       " has no direction of the warp; say where the threads run (`warp=y`, texture or a "
                       "stroke file), or `warp=none`");
  return angle;
}

Threading threading_of(const Mesh& mesh, Face face) {
  const Halfedge h = mesh.halfedge(face);
  const FaceSides made = sides_as_made(mesh, h), now = sides_now(mesh, h);
  const Eigen::Vector2d a = weights_of(mesh, h);
  const Eigen::Vector3d warp = made * a, across = made.col(0).cross(made.col(1)).cross(warp);
  const Eigen::Vector2d b = weights_along(made, across);
  const Eigen::Vector3d along = (now * a).normalized(), weft = (now * b).normalized();
  if (!along.allFinite() || !weft.allFinite()) return {};
  return {{along.x(), along.y(), along.z()}, {weft.x(), weft.y(), weft.z()}};
}

WarpCount count_warp(const Mesh& mesh) {
  WarpCount count{mesh.number_of_faces(), 0, 0};
  for (Face f : mesh.faces()) count.known += weights_of(mesh, mesh.halfedge(f)).allFinite();
  return count;
}

WarpCount set_warp_along(Mesh& mesh, const Vector& axis) {
  const Eigen::Vector3d along = Eigen::Vector3d(axis.x(), axis.y(), axis.z()).normalized();
  if (!(along.norm() > 0.5)) throw std::invalid_argument("set_warp_along: the axis has no length");
  constexpr double least = 0.17364817766693033;  // sin 10 degrees
  auto map = fresh_map(mesh);
  for (Face f : mesh.faces()) {
    const FaceSides sides = sides_as_made(mesh, mesh.halfedge(f));
    const Eigen::Vector2d a = weights_along(sides, along);
    if (a.allFinite() && (sides * a).norm() >= least) map[f] = stored(along);
  }
  return count_warp(mesh);
}

WarpCount set_warp_by_texture(Mesh& mesh, TextureAxis axis) {
  const auto texture = find_map(mesh, attribute::texture);
  if (!texture) throw ContentError("there are no texture coordinates to take the warp from");
  auto map = fresh_map(mesh);
  std::size_t skewed = 0;
  for (Face f : mesh.faces()) {
    const Halfedge h = mesh.halfedge(f);
    const auto at = [&](Halfedge e) { return Eigen::Vector2d((*texture)[e][0], (*texture)[e][1]); };
    const Eigen::Vector2d a = at(mesh.prev(h)), b = at(h), c = at(mesh.next(h));
    Eigen::Matrix2d sides;
    sides << b - a, c - a;
    const double size = sides.col(0).norm() * sides.col(1).norm();
    if (!(std::abs(sides.determinant()) > 1e-9 * size)) continue;
    const Eigen::Matrix<double, 3, 2> grows = sides_as_made(mesh, h) * sides.inverse();
    const Eigen::Vector3d u = grows.col(0).normalized(), v = grows.col(1).normalized();
    if (!u.allFinite() || !v.allFinite()) continue;
    skewed += std::abs(u.dot(v)) > 0.2;
    map[f] = stored(axis == TextureAxis::v ? v : u);
  }
  WarpCount count = count_warp(mesh);
  count.skewed = skewed;
  return count;
}

WarpCount set_warp_by_hints(Mesh& mesh, std::span<const WarpHint> hints) {
  std::map<Face, std::complex<double>> axes;  // e^2ia, longer hints count more
  for (const WarpHint& hint : hints) {
    const Halfedge h = mesh.halfedge(hint.face);
    const Eigen::Vector3d along(hint.along.x(), hint.along.y(), hint.along.z());
    const FaceSides made = sides_as_made(mesh, h);
    const Eigen::Vector2d a = weights_along(sides_now(mesh, h), along);
    if (!a.allFinite()) continue;
    const std::complex<double> z = in_plane(made, made * a);
    if (std::abs(z) > 0) axes[hint.face] += along.norm() * (z / std::abs(z)) * (z / std::abs(z));
  }
  auto map = fresh_map(mesh);
  for (const auto& [f, z] : axes)
    if (std::abs(z) > 0) map[f] = stored(in_space(sides_as_made(mesh, mesh.halfedge(f)), std::arg(z) / 2));
  return count_warp(mesh);
}

}  // namespace furrow::geometry
