// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <vector>

#include "geometry/band/refine_band.h"

namespace furrow::geometry {

/// Lines whose folds meet, straight or by way of others.
struct FoldCluster {
  std::vector<int> lines;         ///< ids, ascending
  std::vector<FoldCurve> curves;  ///< of these lines, in the order given
};

/// Folds meet where faces that they may raise are the same. The order is that of each
/// cluster's last line: what is drawn last comes last, unless it meets what was there. The mesh must have
/// rest lengths. About O(faces of the folds).
std::vector<FoldCluster> clusters_of(const Mesh& mesh, std::span<const FoldCurve> curves,
                                     const BandOptions& options);

/// A curve made on `garment` on what became of that: places in faces that are as they were stay to the last
/// bit, for others the point of the present surface is sought by a walk over it.
FoldCurve carried_to(const Mesh& mesh, const Mesh& garment, const FoldCurve& curve);

/// The faces from which the folds of a cluster take what they need: their bands, and some rings around them.
/// Ascending.
std::vector<Face> faces_to_fold(const Mesh& mesh, std::span<const FoldCurve> curves,
                                const BandOptions& options);

}  // namespace furrow::geometry
