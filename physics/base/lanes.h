// SPDX-License-Identifier: MIT
#pragma once
#include "physics/base/vec4.h"

/// FURROW_VECTOR_CLONES: compiled for AVX2 too, chosen when the program starts. Every operation on lanes is
/// one IEEE operation in one order, without contraction, so all versions give the same bits.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define FURROW_VECTOR_CLONES __attribute__((target_clones("default", "avx2")))
#else
#define FURROW_VECTOR_CLONES
#endif
#define FURROW_INLINE inline __attribute__((always_inline))

namespace furrow::physics {

/// Four lanes of the compiler's vector extension (GCC, Clang).
typedef double Lanes __attribute__((vector_size(32), may_alias));

/// Of four vectors p0 … p3 the four sums (x + y) + z, one a lane: a transposition and two additions.
FURROW_INLINE void sum_xyz(const Lanes& p0, const Lanes& p1, const Lanes& p2, const Lanes& p3, Lanes& sum) {
  const Lanes x01z01 = __builtin_shufflevector(p0, p1, 0, 4, 2, 6),
              y01 = __builtin_shufflevector(p0, p1, 1, 5, 3, 7);
  const Lanes x23z23 = __builtin_shufflevector(p2, p3, 0, 4, 2, 6),
              y23 = __builtin_shufflevector(p2, p3, 1, 5, 3, 7);
  const Lanes x = __builtin_shufflevector(x01z01, x23z23, 0, 1, 4, 5);
  const Lanes y = __builtin_shufflevector(y01, y23, 0, 1, 4, 5);
  const Lanes z = __builtin_shufflevector(x01z01, x23z23, 2, 3, 6, 7);
  sum = (x + y) + z;
}

/// Four numbers in a row, aligned or not: as a place to write to, and read. (Clang takes a reference to the
/// former for aligned.)
typedef double UnalignedLanes __attribute__((vector_size(32), may_alias, aligned(8)));
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"  // it is always inline
FURROW_INLINE Lanes at(const double* p) {
  Lanes lanes;
  __builtin_memcpy(&lanes, p, sizeof lanes);
  return lanes;
}
#pragma GCC diagnostic pop

/// Four copies of one number.
FURROW_INLINE void spread(double s, Lanes& lanes) { lanes = Lanes{s, s, s, s}; }

}  // namespace furrow::physics
