// SPDX-License-Identifier: MIT
#pragma once
#include "physics/thread_pool.h"

namespace furrow::physics {

/// A front of a multifrontal Cholesky factorisation, dense and by columns: `width` columns to be eliminated,
/// each of `stride` doubles, of which the first `height` are rows of the matrix and the rest 0. Entries above
/// the diagonal hold anything. Vectorised (lanes.h); every version gives the same bits.
struct DenseFront {
  double* panel;  ///< width * stride + 4 doubles
  int height, width;
  int stride;  ///< padded(height)
};

/// The least multiple of 4 that is not less than n.
constexpr int padded(int n) { return (n + 3) / 4 * 4; }

/// The front's columns become those of the factor L, in place; false if a pivot is not > 0 or not finite.
/// pool: threads that share the work (null: the caller alone). Cost: width * height^2 multiplications and
/// additions, less what is above the diagonal.
bool eliminate(const DenseFront& front, ThreadPool* pool = nullptr);

/// update -= S S^T below and on the diagonal, S the factor's rows below the eliminated ones; update: height -
/// width columns of stride `update_stride` = padded(height - width).
void subtract_square(const DenseFront& factor, double* update, int update_stride, ThreadPool* pool = nullptr);

/// Forward substitution: x (width) becomes L1^-1 x, and `below` (height - width) loses S x.
void substitute_forward(const DenseFront& factor, double* x, double* below);
/// Backward: x becomes L1^-T (x - S^T below).
void substitute_backward(const DenseFront& factor, double* x, const double* below);

}  // namespace furrow::physics
