// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <vector>

namespace furrow::physics {

/// Numbers in a line of the cache: strides are multiples of it, so that vectors of any processor fit.
template <class Real>
constexpr int line_of = int(64 / sizeof(Real));
/// The least multiple of that which is not less than n.
template <class Real = double>
constexpr int padded(int n) {
  return (n + line_of<Real> - 1) / line_of<Real> * line_of<Real>;
}

/// c (-)= a b^T on and below the diagonal, where c's row i and column i are those of a's row i, and b is a.
/// Of c the rows [from, to), whole lines, and `columns` columns; what is above the diagonal is not read.
template <class Real>
struct ProductOf {
  Real* c;
  int c_stride;
  const Real* a;  ///< `depth` columns; a line more than `to` can be read
  int stride, from, to, columns, depth;
  bool fresh = false;  ///< c = -a b^T; else c -= a b^T
};

using DenseProduct = ProductOf<double>;

/// The inner loops of DenseFront, for float and double. All is by columns; a stride is whole lines. They use
/// fused multiply-add where the processor has it: versions for AVX-512 and AVX2 give the same bits, and a
/// processor without it rounds twice.
template <class Real>
struct KernelsOf {
  const char* name;
  void (*product)(const ProductOf<Real>&);
  /// A square of `columns` becomes its factor, and the rows down to `rows` (whole lines) those of the
  /// factor; false if a pivot is not > 0 or not finite.
  bool (*factorise)(Real* a, int stride, int columns, int rows);
  /// The rows [from, to) of the factor, whole lines below the square's, of such columns.
  void (*solve_rows)(Real* a, int stride, int columns, int from, int to);
  /// x := what is left after elimination of `columns`; x and columns have `stride` rows.
  void (*forward)(const Real* a, int stride, int columns, Real* x);
  /// The first `columns` of x become the solution, the others of its `height` rows are known.
  void (*backward)(const Real* a, int stride, int columns, Real* x);
};

using DenseKernels = KernelsOf<double>;

/// The fastest for this processor; Real: float or double.
template <class Real = double>
const KernelsOf<Real>& dense_kernels();
/// All that run on this processor, the fastest first.
template <class Real = double>
std::vector<const KernelsOf<Real>*> all_dense_kernels();

}  // namespace furrow::physics
