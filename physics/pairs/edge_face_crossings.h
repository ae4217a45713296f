// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

#include "physics/pairs/pair_mesh.h"

namespace furrow::physics {

/// An edge that passes through a triangle with which it shares no vertex.
struct EdgeFaceCrossing {
  int edge, triangle;
  auto operator<=>(const EdgeFaceCrossing&) const = default;
};

/// All of them at x, sorted; where rounding leaves it open (an edge that touches a triangle), they count as
/// crossing. Cost: some 1 us a triangle.
std::vector<EdgeFaceCrossing> edge_face_crossings(const PairMesh& mesh, std::span<const Vec3> x);

/// The pairs that such a crossing consists of: the edge's ends against the triangle, and it against the
/// triangle's edges; without those that share a vertex. Added to `keys`.
void add_pairs_of(const EdgeFaceCrossing& crossing, const PairMesh& mesh, std::vector<PairKey>& keys);

}  // namespace furrow::physics
