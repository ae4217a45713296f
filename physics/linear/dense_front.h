// SPDX-License-Identifier: MIT
#pragma once
#include "physics/base/thread_pool.h"

namespace furrow::physics {

/// A front of a multifrontal Cholesky factorisation, dense and by columns: `width` columns to be eliminated,
/// each of `stride` doubles, of which the first `height` are rows of the matrix and the rest 0. Entries above
/// the diagonal hold anything. Vectorised (DenseKernels): the same bits for any number of threads, and on
/// every processor that has fused multiply-add.
struct DenseFront {
  double* panel;  ///< width * stride + 8 doubles
  int height, width;
  int stride;  ///< padded(height)
};

/// The least multiple of 8 that is not less than n.
constexpr int padded(int n) { return (n + 7) / 8 * 8; }

/// The front's columns become those of the factor L, in place; false if a pivot is not > 0 or not finite.
/// pool: threads that share the work (null: the caller alone). Cost: width * height^2 multiplications and
/// additions, less what is above the diagonal.
bool eliminate(const DenseFront& front, ThreadPool* pool = nullptr);

/// update = -S S^T below and on the diagonal, S the factor's rows below the eliminated ones; update: height -
/// width columns of stride `update_stride` = padded(height - width). What stood there does not count.
void negative_square(const DenseFront& factor, double* update, int update_stride, ThreadPool* pool = nullptr);

/// Forward substitution of x (stride numbers, those behind `height` 0): its first `width` become L1^-1 x1,
/// the others lose S of these.
void substitute_forward(const DenseFront& factor, double* x);
/// Backward: x1 becomes L1^-T (x1 - S^T x2).
void substitute_backward(const DenseFront& factor, double* x);

}  // namespace furrow::physics
