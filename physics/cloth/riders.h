// SPDX-License-Identifier: MIT
#pragma once
#include <array>

#include "physics/cloth/cloth.h"

namespace furrow::physics {

/// Puts each rider of a cloth where its triangle is now, with the velocity of that place. The triangle's
/// frame: along its first edge, across that in its plane, along its normal. One that has no area leaves its
/// riders where they are. O(riders).
void place_riders(Cloth& cloth);

/// The rider that lies at x [m] and rides on a triangle that lies so: as far along each direction of its
/// frame from the point with these weights. corners: [m], with area; weights: sum 1.
Rider rider_at(const Vec3& x, int particle, const std::array<int, 3>& triangle,
               const std::array<Vec3, 3>& corners, const Vec3& weights);

}  // namespace furrow::physics
