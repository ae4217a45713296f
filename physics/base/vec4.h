// SPDX-License-Identifier: MIT
#pragma once

namespace furrow::physics {

/// Four doubles that fill a vector register; w is 0 in all arrays of a packed cloth.
struct alignas(32) Vec4 {
  double x = 0, y = 0, z = 0, w = 0;
};

}  // namespace furrow::physics
