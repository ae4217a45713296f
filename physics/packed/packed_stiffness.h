// SPDX-License-Identifier: MIT
#pragma once
#include "physics/base/arrays.h"
#include "physics/packed/packed_elements.h"

namespace furrow::physics {

/// Blocks of the positive part (Stiffness::positive_part) of triangles, or of hinges of the linear law, four
/// at a time: those of stiffness_blocks() on and below the diagonal, but for rounding. begin, end: elements
/// in the packed order; x: by place. Cost: no division a triangle but where it is pressed, two a hinge.
void triangle_blocks(const PackedElements& elements, const Vec4* x, int begin, int end, Mat3* blocks);
void hinge_blocks(const PackedElements& elements, const Vec4* x, int begin, int end, Mat3* blocks);

}  // namespace furrow::physics
