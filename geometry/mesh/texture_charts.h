// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include "geometry/mesh/face_point.h"
#include "geometry/mesh/property_names.h"

namespace furrow::geometry {

/// The texture coordinates of a mesh of triangles as a plane of triangles, and its charts: sets of faces
/// joined by edges across which the coordinates agree to 1e-7. The mesh must outlive it and stay unchanged.
class TextureCharts {
 public:
  /// Throws ContentError if the mesh has no texture coordinates or a face is no triangle. O(faces).
  explicit TextureCharts(const Mesh& mesh);

  /// Of the corners of a face, as FacePoint counts them.
  std::array<TextureCoordinate, 3> corners(Face face) const;
  /// Of a face's corner at the source or target of its halfedge.
  TextureCoordinate at_source(Halfedge h) const { return texture_[mesh_.prev(h)]; }
  TextureCoordinate at_target(Halfedge h) const { return texture_[h]; }
  /// Twice the area in the texture, < 0 where it is mirrored; NaN or 0: the face has no place there.
  double signed_area(Face face) const;
  Barycentrics barycentrics(Face face, const TextureCoordinate& point) const;
  /// The faces whose closed triangle holds the point (to 1e-9 of its barycentrics); ascending. O(faces).
  std::vector<Face> faces_at(const TextureCoordinate& point) const;
  bool is_seam(Edge edge) const;
  int chart(Face face) const { return chart_[face.idx()]; }

 private:
  void join_faces();
  const Mesh& mesh_;
  HalfedgeMap<TextureCoordinate> texture_;
  std::vector<int> chart_;  ///< by face
};

}  // namespace furrow::geometry
