// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "geometry/mesh/mesh_fwd.h"
#include "physics/cloth/cloth.h"

namespace furrow::bridge {

/// The vertices of parts that ride (geometry/figure/attached_parts.h), each on the triangle of cloth that it
/// lay nearest to as the garment was made, and as far off. A part that goes place by place, and dips through
/// the cloth, is put to the side that most of it lies on; none where all parts ride. And the vertices that
/// are one with others at a seam (attribute::joined). Cost: O(log faces) a rider.
std::vector<physics::Rider> riders_of(const geometry::Mesh& mesh);

/// Makes their particles riders of the cloth. Their masses go to the corners of the triangles.
void gather_riders(const geometry::Mesh& mesh, physics::Cloth& cloth);

/// Puts them where the cloth lies now.
void bring_riders_along(geometry::Mesh& mesh);

}  // namespace furrow::bridge
