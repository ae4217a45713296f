// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>

#include "physics/base/arrays.h"

namespace furrow::physics {

/// The part of a triangle (0, 1, 2) that a closest point lies on; edge01 runs from corner 0 to corner 1.
enum class Feature : std::uint8_t { face, edge01, edge12, edge20, corner0, corner1, corner2 };

struct PointOnTriangle {
  Vec3 point;
  Feature feature;
};

/// Closest point to x of the triangle (a, b, c) by the Voronoi regions of its features; a triangle without
/// area is treated as its three edges. Source: Ericson, Real-Time Collision Detection, 5.1.5.
PointOnTriangle closest_on_triangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace furrow::physics
