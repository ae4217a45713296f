// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <optional>
#include <span>

#include "geometry/mesh/face_point.h"

namespace furrow::geometry {

struct SurfaceHit {
  FacePoint point;
  Point position;          ///< [m]
  double distance = 0;     ///< of the query from `position`, along the ray if there was one [m]
  bool on_border = false;  ///< `position` lies on a border edge or border vertex
  double beyond_border =
      0;  ///< how far the query lies beyond the border, in the face's plane [m]; 0 unless on_border
};

/// Closest points and ray hits on a triangle mesh (a CGAL AABB tree: built in O(n log n), queried in about
/// O(log n)). The mesh must outlive it and stay unchanged. Queries are const.
class SurfaceProjector {
 public:
  /// Throws ContentError if the mesh has no face.
  explicit SurfaceProjector(const Mesh& mesh);
  ~SurfaceProjector();
  SurfaceProjector(const SurfaceProjector&) = delete;
  SurfaceProjector& operator=(const SurfaceProjector&) = delete;

  SurfaceHit closest(const Point& query) const;
  /// The closest point on one of the given faces (at least one); O(faces).
  SurfaceHit closest_among(const Point& query, std::span<const Face> faces) const;
  /// The nearest face along the ray that faces its origin; if none does, the nearest of all; none if the ray
  /// misses. A ray through an edge or a vertex hits, too: a face within 1e-9 of the mesh's size counts.
  std::optional<SurfaceHit> first_hit(const Point& origin, const Vector& direction) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

/// Barycentrics of the point of the face's plane that is closest to `query`.
Barycentrics barycentrics_of(const Mesh& mesh, Face face, const Point& query);

}  // namespace furrow::geometry
