// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <vector>

#include "geometry/insert/mesh_editor.h"
#include "geometry/insert/texture_maps.h"

namespace furrow::geometry {

/// The surface as it was before it was refined, which refined vertices stay on. A copy: the mesh given may
/// change.
class BaseSurface {
 public:
  /// O(faces).
  explicit BaseSurface(const Mesh& mesh);

  const Mesh& mesh() const { return mesh_; }
  Point position(const FacePoint& place) const { return position_of(mesh_, place); }
  /// The place of a vertex: of its faces, the one with the lowest corners. The vertex must have a face.
  FacePoint of_vertex(Vertex v) const;
  /// The point of the surface nearest to `p` that a walk from the face of `from` comes to; it stops at the
  /// border and at seams. Weights below 1e-12 become 0. O(faces passed).
  FacePoint project(const FacePoint& from, const Point& p) const;
  /// Texture coordinates there, in the charts of the place's face.
  CornerTexture texture(const FacePoint& place) const;
  /// Whether texture, group or material change across this edge.
  bool is_seam(Edge e) const { return seam_[e.idx()]; }

 private:
  Mesh mesh_;
  std::vector<bool> seam_;
  TextureMaps texture_;
};

/// Barycentrics of the point of a triangle's plane nearest to `p`.
Barycentrics plane_barycentrics(const std::array<Point, 3>& corners, const Point& p);
/// Of the point of the triangle nearest to `p`.
Barycentrics nearest_barycentrics(const std::array<Point, 3>& corners, const Point& p);
/// Walks over `mesh` from a face to the one nearest to `p`, through edges that `may_cross` allows.
template <class MayCross>
FacePoint walk_towards(const Mesh& mesh, Face from, const Point& p, const MayCross& may_cross) {
  constexpr int most = 1000;
  Face face = from, last;
  for (int step = 0;; ++step) {
    const auto c = corners_of(mesh, face);
    const std::array<Point, 3> points{mesh.point(c[0]), mesh.point(c[1]), mesh.point(c[2])};
    const Barycentrics b = plane_barycentrics(points, p);
    int out = 0;
    for (int i : {1, 2})
      if (b[i] < b[out]) out = i;
    if (b[out] >= 0) return {face, b};
    const Halfedge beyond = mesh.opposite(halfedges_of(mesh, face)[(out + 1) % 3]);
    const bool stop = mesh.is_border(beyond) || step == most || mesh.face(beyond) == last;
    if (stop || !may_cross(mesh.edge(beyond))) return {face, nearest_barycentrics(points, p)};
    last = face;
    face = mesh.face(beyond);
  }
}

}  // namespace furrow::geometry
