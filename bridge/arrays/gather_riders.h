// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/mesh/mesh_fwd.h"
#include "physics/cloth/cloth.h"

namespace furrow::bridge {

/// Makes the particles of parts that ride (geometry/figure/attached_parts.h) riders of the cloth's triangles
/// that they lay nearest to as the garment was made. Their masses go to those triangles' corners. A
/// part that goes place by place, and dips through the cloth, is put to the side that most of it lies on.
/// Nothing changes where no part rides, or all do. Cost: O(log faces) a rider.
void gather_riders(const geometry::Mesh& mesh, physics::Cloth& cloth);

}  // namespace furrow::bridge
