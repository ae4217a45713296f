// SPDX-License-Identifier: MIT
#pragma once
#include "physics/base/arrays.h"

namespace furrow::physics {

/// Four doubles that fill a vector register; w is 0 in all arrays of a packed cloth.
struct alignas(32) Vec4 {
  double x = 0, y = 0, z = 0, w = 0;
};

inline Vec3 xyz(const Vec4& v) { return {v.x, v.y, v.z}; }

}  // namespace furrow::physics
