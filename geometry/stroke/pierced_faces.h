// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <span>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

/// By face index, whether a face crosses or touches the triangles of another surface (1) or not (0), decided
/// exactly for the given coordinates. `triangles` index `points`. Triangles without area, on either side, are
/// left out: their neighbours have their edges. Faces with every corner on one side may be pierced all the
/// same; where none is and the surface is closed, each connected part of the mesh lies wholly on one side.
/// Throws ContentError if a position is not finite, a face is no triangle, or an index is out of range.
/// Cost: O(n log n + pairs of overlapping boxes), n faces and triangles together; exact predicates.
std::vector<char> pierced_faces(const Mesh& mesh, std::span<const Point> points,
                                std::span<const std::array<int, 3>> triangles);

}  // namespace furrow::geometry
