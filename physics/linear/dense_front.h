// SPDX-License-Identifier: MIT
#pragma once
#include "physics/base/thread_pool.h"
#include "physics/linear/dense_kernels.h"

namespace furrow::physics {

/// A front of a multifrontal Cholesky factorisation, dense and by columns: `width` columns to be eliminated,
/// each of `stride` numbers, of which the first `height` are rows of the matrix and the rest 0. Entries above
/// the diagonal hold anything. Vectorised (DenseKernels): the same bits for any number of threads, and on
/// every processor that has fused multiply-add.
template <class Real>
struct FrontOf {
  Real* panel;  ///< width * stride numbers and a line
  int height, width;
  int stride;  ///< padded<Real>(height)
};

using DenseFront = FrontOf<double>;

/// The front's columns become those of the factor L, in place; false if a pivot is not > 0 or not finite.
/// pool: threads that share the work (null: the caller alone). Cost: width * height^2 multiplications and
/// additions, less what is above the diagonal.
template <class Real>
bool eliminate(const FrontOf<Real>& front, ThreadPool* pool = nullptr);

/// update = -S S^T below and on the diagonal, S the factor's rows below the eliminated ones; update: height -
/// width columns of stride `update_stride` = padded<Real>(height - width). What stood there does not count.
template <class Real>
void negative_square(const FrontOf<Real>& factor, Real* update, int update_stride,
                     ThreadPool* pool = nullptr);

/// Forward substitution of x (stride numbers, those behind `height` 0): its first `width` become L1^-1 x1,
/// the others lose S of these.
template <class Real>
void substitute_forward(const FrontOf<Real>& factor, Real* x);
/// Backward: x1 becomes L1^-T (x1 - S^T x2).
template <class Real>
void substitute_backward(const FrontOf<Real>& factor, Real* x);

}  // namespace furrow::physics
