// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>

namespace furrow::physics {

/// Four floats that are computed with together (GCC's and Clang's vector extension: any processor, the same
/// bits).
typedef float Float4 __attribute__((vector_size(16)));

inline Float4 splat(float a) { return Float4{a, a, a, a}; }
inline Float4 min(Float4 a, Float4 b) { return a < b ? a : b; }
inline Float4 max(Float4 a, Float4 b) { return a > b ? a : b; }
inline Float4 positive_part(Float4 a) { return a > splat(0) ? a : splat(0); }
inline Float4 absolute(Float4 a) {
  typedef int Int4 __attribute__((vector_size(16)));
  return reinterpret_cast<Float4>(reinterpret_cast<Int4>(a) &
                                  Int4{0x7fffffff, 0x7fffffff, 0x7fffffff, 0x7fffffff});
}
inline Float4 square_root(Float4 a) {
  return Float4{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
}
inline float least(Float4 a) {
  const float b = a[0] < a[1] ? a[0] : a[1], c = a[2] < a[3] ? a[2] : a[3];
  return b < c ? b : c;
}
inline Float4 clamp01(Float4 a) { return min(max(a, splat(0)), splat(1)); }

}  // namespace furrow::physics
