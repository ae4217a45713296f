// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <vector>

#include "geometry/mesh/warp_map.h"

/// Where the threads of woven cloth run: f:warp, one direction a face, as an axis without an arrow. It is
/// kept with the shape that the cloth had before lines, pose and motion, and carried to any other by the
/// triangles' corners; a part of a face has that of the whole (attribute_register.h).
namespace furrow::geometry {

/// How many faces a source gave a direction to.
struct WarpCount {
  std::size_t faces = 0;   ///< of the mesh
  std::size_t known = 0;   ///< with a direction now
  std::size_t skewed = 0;  ///< from a texture whose u and v are more than 12 degrees off a right angle there
};

/// The angle of the warp to a halfedge in the metric of rest of its face, counter-clockwise [rad]; NaN where
/// it is not known, is normal to the face, or the face has no area. rest: rest_lengths(mesh).
double warp_angle(const Mesh& mesh, Halfedge h, const std::vector<double>& rest);
/// The same; throws ContentError that names the face where there is none.
double known_warp_angle(const Mesh& mesh, Halfedge h, const std::vector<double>& rest);

/// Unit vectors along warp and weft of a face as it lies now; zero where they are not known.
struct Threading {
  Vector warp{0, 0, 0}, weft{0, 0, 0};
};
Threading threading_of(const Mesh& mesh, Face face);

/// Faces with a direction.
WarpCount count_warp(const Mesh& mesh);

/// The warp runs as an axis in space does, projected on each face; faces within 10 degrees of being normal to
/// it get none. Replaces what is there. Throws std::invalid_argument for an axis of no length.
WarpCount set_warp_along(Mesh& mesh, const Vector& axis);

/// The direction on each face in which a texture coordinate grows, v or u, with the other one constant; faces
/// without a place in the texture get none. Replaces what is there. Throws ContentError without coordinates.
enum class TextureAxis { u, v };
WarpCount set_warp_by_texture(Mesh& mesh, TextureAxis axis);

/// A direction on a face as it lies now.
struct WarpHint {
  Face face;
  Vector along;  ///< of any length > 0; more of one face are added up as axes
};
/// The warp runs so on these faces, and is not known on all others. Replaces what is there.
WarpCount set_warp_by_hints(Mesh& mesh, std::span<const WarpHint> hints);

}  // namespace furrow::geometry
