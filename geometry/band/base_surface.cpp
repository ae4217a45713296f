// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/band/base_surface.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace furrow::geometry {
namespace {

constexpr double least_weight = 1e-12;

/// Zero for what rounding left.
Barycentrics cleaned(Barycentrics b) {
  double sum = 0;
  for (double& x : b) sum += x = x < least_weight ? 0 : x;
  for (double& x : b) x /= sum;
  return b;
}

std::array<Vertex, 3> sorted_corners(const Mesh& mesh, Face f) {
  auto c = corners_of(mesh, f);
  std::sort(c.begin(), c.end());
  return c;
}

}  // namespace

Barycentrics plane_barycentrics(const std::array<Point, 3>& c, const Point& p) {
  const Vector u = c[1] - c[0], v = c[2] - c[0], w = p - c[0];
  const double uu = u * u, uv = u * v, vv = v * v, wu = w * u, wv = w * v;
  const double determinant = uu * vv - uv * uv;
  if (!(determinant > 0)) return {1, 0, 0};
  const double b1 = (vv * wu - uv * wv) / determinant, b2 = (uu * wv - uv * wu) / determinant;
  return {1 - b1 - b2, b1, b2};
}

Barycentrics nearest_barycentrics(const std::array<Point, 3>& c, const Point& p) {
  const Barycentrics inside = plane_barycentrics(c, p);
  if (inside[0] >= 0 && inside[1] >= 0 && inside[2] >= 0) return inside;
  Barycentrics best{1, 0, 0};
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const Vector side = c[j] - c[i];
    const double squared = side.squared_length();
    const double t = squared > 0 ? std::clamp(((p - c[i]) * side) / squared, 0.0, 1.0) : 0;
    const double d = (p - (c[i] + t * side)).squared_length();
    if (!(d < least)) continue;
    least = d;
    best = {0, 0, 0};
    best[i] = 1 - t;
    best[j] = t;
  }
  return best;
}

BaseSurface::BaseSurface(const Mesh& mesh) : mesh_(mesh), seam_(mesh.num_edges(), false), texture_(mesh_) {
  const MeshEditor editor(mesh_);  // adds the maps that insertion needs
  for (Edge e : mesh_.edges()) seam_[e.idx()] = !mesh_.is_border(e) && editor.is_seam(e);
}

FacePoint BaseSurface::of_vertex(Vertex v) const {
  Face best;
  for (Halfedge h : mesh_.halfedges_around_target(mesh_.halfedge(v))) {
    if (mesh_.is_border(h)) continue;
    const Face f = mesh_.face(h);
    if (!best.is_valid() || sorted_corners(mesh_, f) < sorted_corners(mesh_, best)) best = f;
  }
  FacePoint place{best, {0, 0, 0}};
  const auto c = corners_of(mesh_, best);
  place.barycentrics[std::find(c.begin(), c.end(), v) - c.begin()] = 1;
  return place;
}

FacePoint BaseSurface::project(const FacePoint& from, const Point& p) const {
  FacePoint at = walk_towards(mesh_, from.face, p, [&](Edge e) { return !seam_[e.idx()]; });
  at.barycentrics = cleaned(at.barycentrics);
  return at;
}

CornerTexture BaseSurface::texture(const FacePoint& place) const {
  const auto h = halfedges_of(mesh_, place.face);
  return blend_corners({texture_.at(h[2]), texture_.at(h[0]), texture_.at(h[1])}, place.barycentrics);
}

}  // namespace furrow::geometry
