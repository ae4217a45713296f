// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

/// A folded cloth as heights over the surface that it was before its folds. By vertex index; NaN where a
/// vertex has no foot.
struct FoldSurface {
  const Mesh* mesh = nullptr;         ///< as it is; must outlive this
  std::vector<Eigen::Vector3d> feet;  ///< on the surface before, below or above the vertex [m]
  std::vector<double> heights;        ///< over it, along its normal at the foot [m]
  bool has_foot(Vertex v) const;
};

/// Over the places where the mesh's own vertices lay: one for each. Where a vertex went sideways, its foot
/// did. Throws std::invalid_argument for another number of places. O(vertices + faces).
FoldSurface surface_over(const Mesh& mesh, std::span<const Point> before);

/// Over another mesh: the garment before its folds, of any fineness. Unless `flat`, heights count from the
/// curved surface over its facets that rule fold raises folds from (fold/fold_base.h), so that a coarse
/// garment's facets are no ripples. A vertex whose nearest face looks the other way, as that of another layer
/// does, has no foot. Throws ContentError for a base without faces. O(vertices log faces).
FoldSurface surface_over(const Mesh& mesh, const Mesh& base, bool flat = false);

}  // namespace furrow::geometry
