// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

namespace furrow::physics {

/// c (-)= a b^T on and below the diagonal, where c's row i and column i are those of a's row i, and b is a.
/// Of c the rows [from, to), multiples of 8, and `columns` columns; what is above the diagonal is not read.
struct DenseProduct {
  double* c;
  int c_stride;
  const double* a;  ///< `depth` columns; 8 rows more than `to` can be read
  int stride, from, to, columns, depth;
  bool fresh = false;  ///< c = -a b^T; else c -= a b^T
};

/// The inner loops of DenseFront. All is by columns; a stride is a multiple of 8 doubles. They use fused
/// multiply-add where the processor has it: versions for AVX-512 and AVX2 give the same bits, and a processor
/// without it rounds twice.
struct DenseKernels {
  const char* name;
  void (*product)(const DenseProduct&);
  /// A square of `columns` becomes its factor, and the rows down to `rows` (a multiple of 8) those of the
  /// factor; false if a pivot is not > 0 or not finite.
  bool (*factorise)(double* a, int stride, int columns, int rows);
  /// The rows [from, to) of the factor, multiples of 8 below the square's, of such columns.
  void (*solve_rows)(double* a, int stride, int columns, int from, int to);
  /// x := what is left after elimination of `columns`; x and columns have `stride` rows.
  void (*forward)(const double* a, int stride, int columns, double* x);
  /// The first `columns` of x become the solution, the others of its `height` rows are known.
  void (*backward)(const double* a, int stride, int columns, double* x);
};

/// The fastest for this processor.
const DenseKernels& dense_kernels();
/// All that run on this processor, the fastest first.
std::vector<const DenseKernels*> all_dense_kernels();

}  // namespace furrow::physics
