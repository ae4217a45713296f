// SPDX-License-Identifier: MIT
#pragma once

namespace furrow::physics {

/// Four floats that are computed with together (GCC's and Clang's vector extension: any processor, the same bits).
typedef float Float4 __attribute__((vector_size(16)));

inline Float4 splat(float a) { return Float4{a, a, a, a}; }
inline Float4 min(Float4 a, Float4 b) { return a < b ? a : b; }
inline Float4 max(Float4 a, Float4 b) { return a > b ? a : b; }
inline Float4 clamp01(Float4 a) { return min(max(a, splat(0)), splat(1)); }

}  // namespace furrow::physics
