// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include "geometry/mesh/face_point.h"

namespace furrow::geometry {

/// Unit normal of a vertex, its faces' normals weighted by their angles there; 0 without faces.
std::vector<Vector> vertex_normals(const Mesh& mesh);

/// The frame at a corner of a face. The bitangent is sign · normal × tangent.
struct CornerFrame {
  Vector normal{0, 0, 0}, tangent{0, 0, 0};  ///< unit, orthogonal
  double sign = 1;                           ///< -1 where the texture is mirrored
};
/// By face index; corner i is the source of the i-th halfedge, as in FacePoint.
using TangentFrames = std::vector<std::array<CornerFrame, 3>>;

/// MikkTSpace's tangents for smooth vertex normals: a face's tangent is the direction in which u grows on
/// it; a corner's is the sum over the faces around its vertex that hang together with its own across edges
/// without a texture seam and are mirrored or not alike, each projected to the normal's plane, made unit and
/// weighted by the angle of its projected corner. Faces whose texture has no area, or no coordinates, take
/// part in none and get any tangent. (M. Mikkelsen, "Simulation of wrinkled surfaces revisited", 2008; his
/// mikktspace.c with no angle limit. Normals are not split, and vertices not welded beyond the mesh's own.)
/// O(faces × valence).
TangentFrames tangent_frames(const Mesh& mesh);

/// The frame inside a face, as renderers interpolate it: normal and tangent linear and not made unit, the
/// bitangent their cross product times the sign. Columns of `axes`: tangent, bitangent, normal.
struct InnerFrame {
  Vector tangent, bitangent, normal;
};
InnerFrame frame_inside(const std::array<CornerFrame, 3>& corners, const Barycentrics& barycentrics);
/// The same made orthonormal, normal first.
InnerFrame orthonormal(const InnerFrame& frame);

}  // namespace furrow::geometry
