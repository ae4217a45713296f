// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "physics/body/surface_topology.h"
#include "physics/body/triangle_bvh.h"

namespace furrow::physics {

/// One entry a triangle: 1 where it may meet another triangle elsewhere than in shared corners and edges
/// (crossing, touching within 1e-9 of its size, folded flat onto a neighbour), 0 where it surely does not.
/// Pairs of triangles that both have a corner which more than a thousand share are taken not to meet: it
/// would take quadratic time. Cost about 1 us a triangle. Call it before TriangleBvh::drop().
std::vector<char> crossed_triangles(const TriangleBvh& bvh, const SurfaceTopology& topology);

/// Whether the segment from p to q may meet the triangle (a, b, c); rounding counts as meeting.
bool segment_meets_triangle(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace furrow::physics
