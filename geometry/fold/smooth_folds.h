// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <set>

#include "geometry/fold/taubin_smooth.h"

namespace furrow::geometry {

/// Taubin's filter over raised cloth, lines and border as curves: it takes what roughness is left. Weights
/// are the cotangents of the mesh as it lies, so that vertices move across the surface, not along it. Nowhere
/// does a face become thinner than it was and than 15 degrees: there the corners go back. Of `options` only
/// iterations, lambda and mu count. Returns how many vertices went back. Throws as taubin_smooth().
std::size_t smooth_folds(Mesh& mesh, std::span<const Vertex> region, const TaubinOptions& options);

}  // namespace furrow::geometry
