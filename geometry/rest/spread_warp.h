// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/rest/warp_directions.h"

namespace furrow::geometry {

/// Gives faces without a direction of the warp the one that turns least along the cloth from those that have
/// one, which stay: with z = e^2ia of each face, the least sum over the edges between faces f and g of
/// 3 l^2 / (A_f + A_g) |z_f - r z_g|^2, r the turn between their frames across the unfolded edge. Parts of
/// the garment without any direction stay without. One sparse solve, O(faces^1.5). Same input, same bits.
WarpCount spread_warp(Mesh& mesh);

}  // namespace furrow::geometry
