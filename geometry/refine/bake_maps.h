// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "geometry/mesh/mesh_fwd.h"

namespace furrow::geometry {

/// A texture of vectors: size² of them, rows from the top (texture_raster.h).
struct VectorMap {
  int size = 0;
  std::vector<std::array<float, 3>> texels;
};

struct BakeOptions {
  int size = 2048;  ///< of the square maps [texels]; [1, 8192]
  int padding = 8;  ///< how far values go on beyond the charts' borders [texels]; [0, 1024]
};

struct BakedMaps {
  VectorMap displacement;       ///< along tangent, bitangent, normal [m]; 0 where nothing was baked
  VectorMap normal;             ///< unit, in the same order; (0, 0, 1) where nothing was baked
  std::size_t covered = 0;      ///< texels inside charts of the low mesh
  std::size_t unmatched = 0;    ///< of them, those that the high mesh's charts leave out
  std::size_t overlapping = 0;  ///< texels where charts of the low mesh lie on one another
  double largest = 0;           ///< largest component of a displacement [m]
};

/// Called some hundred times with the share done; false: stop.
using BakeObserver = std::function<bool(double share)>;

/// What the surface of `high` is to that of `low`, as textures: a texel's place on both is found by their
/// texture coordinates, which must agree (insertion and subdivision keep them). The displacement leads from
/// the flat faces of `low` to those of `high`, the normal is the smooth one of `high`. Nothing: the observer
/// stopped it. Throws std::invalid_argument for an option; ContentError if a mesh has no texture coordinates
/// or leaves the unit square, or if more than half of the covered texels are unmatched. O(texels).
/// \details The displacement is given in orthonormal(frame_inside(...)) of `low`; the normal in
/// frame_inside(...), not orthonormalised, which is what MikkTSpace's users invert (tangent_frames.h), with
/// +y along growing v ("OpenGL"). Beyond the charts' borders the first texel goes on affinely, so that
/// interpolation between texels is right up to the border; the others repeat it.
std::optional<BakedMaps> bake_maps(const Mesh& low, const Mesh& high, const BakeOptions& options = {},
                                   const BakeObserver& observer = {});

}  // namespace furrow::geometry
