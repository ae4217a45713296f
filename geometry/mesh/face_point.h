// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cmath>

#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

using Barycentrics = std::array<double, 3>;  ///< weights of the corners [-]; their sum is 1

/// A point in a triangle. Corner i is the source of the i-th halfedge, counted from mesh.halfedge(face): it
/// holds until the face is changed.
struct FacePoint {
  Face face;
  Barycentrics barycentrics;
};

/// Halfedge i leads from corner i to corner i + 1.
inline std::array<Halfedge, 3> halfedges_of(const Mesh& mesh, Face face) {
  const Halfedge h = mesh.halfedge(face);
  return {h, mesh.next(h), mesh.next(mesh.next(h))};
}

inline std::array<Vertex, 3> corners_of(const Mesh& mesh, Face face) {
  const auto h = halfedges_of(mesh, face);
  return {mesh.source(h[0]), mesh.source(h[1]), mesh.source(h[2])};
}

inline Point position_of(const Mesh& mesh, const FacePoint& p) {
  const auto c = corners_of(mesh, p.face);
  Vector sum(0, 0, 0);
  for (int i = 0; i < 3; ++i) sum = sum + p.barycentrics[i] * (mesh.point(c[i]) - CGAL::ORIGIN);
  return CGAL::ORIGIN + sum;
}

/// Twice the area times the unit normal [m^2].
inline Vector area_normal_of(const Mesh& mesh, Face face) {
  const auto c = corners_of(mesh, face);
  const Point& p = mesh.point(c[0]);
  return CGAL::cross_product(mesh.point(c[1]) - p, mesh.point(c[2]) - p);
}

/// v / |v|, or v itself if it has no length.
inline Vector normalized(const Vector& v) {
  const double length = std::sqrt(v.squared_length());
  return length > 0 ? v / length : v;
}

}  // namespace furrow::geometry
