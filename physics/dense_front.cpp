// SPDX-License-Identifier: MIT
#include "physics/dense_front.h"

#include <cmath>
#include <cstddef>

#include "physics/lanes.h"

namespace furrow::physics {
namespace {

constexpr int block = 16;  // columns that are eliminated between two products

/// Four lanes at any address.
typedef double LanesAnywhere __attribute__((vector_size(32), aligned(8), may_alias));
FURROW_INLINE const LanesAnywhere& load(const double* p) {
  return *reinterpret_cast<const LanesAnywhere*>(p);
}
FURROW_INLINE void store(double* p, const Lanes& v) { *reinterpret_cast<LanesAnywhere*>(p) = v; }

/// c (4 `Tall` rows x `Wide` columns) -= a b^T over `depth` columns of a and b.
template <int Tall, int Wide>
FURROW_INLINE void subtract_tile(double* c, int c_stride, const double* a, const double* b, int stride,
                                 int depth) {
  Lanes sum[Tall][Wide] = {};
  for (int k = 0; k < depth; ++k, a += stride, b += stride) {
    Lanes rows[Tall];
#pragma GCC unroll 2
    for (int t = 0; t < Tall; ++t) rows[t] = load(a + 4 * t);
#pragma GCC unroll 4
    for (int w = 0; w < Wide; ++w) {
      const Lanes factor = Lanes{} + b[w];
#pragma GCC unroll 2
      for (int t = 0; t < Tall; ++t) sum[t][w] += rows[t] * factor;
    }
  }
#pragma GCC unroll 4
  for (int w = 0; w < Wide; ++w)
#pragma GCC unroll 2
    for (int t = 0; t < Tall; ++t)
      store(c + w * c_stride + 4 * t, load(c + w * c_stride + 4 * t) - sum[t][w]);
}

/// `Wide` columns of c, `rows` (a multiple of 4) from their top.
template <int Wide>
FURROW_INLINE void subtract_columns(double* c, int c_stride, const double* a, const double* b, int stride,
                                    int rows, int depth) {
  int r = 0;
  for (; r + 8 <= rows; r += 8) subtract_tile<2, Wide>(c + r, c_stride, a + r, b, stride, depth);
  if (r < rows) subtract_tile<1, Wide>(c + r, c_stride, a + r, b, stride, depth);
}

/// c -= a b^T on and below the diagonal, where c's row i and column i are those of a's and b's rows i.
/// rows: of c and a, a multiple of 4; columns: of c, rows of b.
FURROW_INLINE void subtract_lower(double* c, int c_stride, const double* a, int stride, int rows, int columns,
                                  int depth) {
  int j = 0;
  for (; j + 4 <= columns; j += 4)
    subtract_columns<4>(c + j + std::ptrdiff_t(j) * c_stride, c_stride, a + j, a + j, stride, rows - j,
                        depth);
  for (; j < columns; ++j) {
    const int from = j / 4 * 4;  // whole lanes; what is above the diagonal does not count
    subtract_columns<1>(c + from + std::ptrdiff_t(j) * c_stride, c_stride, a + from, a + j, stride,
                        rows - from, depth);
  }
}

/// column[from...stride) -= factor * other.
FURROW_INLINE void subtract_multiple(double* column, const double* other, double factor, int from,
                                     int stride) {
  const Lanes f = Lanes{} + factor;
  for (int r = from / 4 * 4; r < stride; r += 4) store(column + r, load(column + r) - f * load(other + r));
}

FURROW_VECTOR_CLONES bool eliminate_columns(const DenseFront& f) {
  for (int k = 0; k < f.width; k += block) {
    const int end = k + block < f.width ? k + block : f.width;
    double* first = f.panel + std::ptrdiff_t(k) * f.stride;
    if (k > 0) subtract_lower(first + k, f.stride, f.panel + k, f.stride, f.stride - k, end - k, k);
    for (int j = k; j < end; ++j) {
      double* column = f.panel + std::ptrdiff_t(j) * f.stride;
      for (int i = k; i < j; ++i) {
        const double* done = f.panel + std::ptrdiff_t(i) * f.stride;
        subtract_multiple(column, done, done[j], j, f.stride);
      }
      const double pivot = column[j];
      if (!(pivot > 0) || !std::isfinite(pivot)) return false;
      const double root = std::sqrt(pivot);
      const Lanes scale = Lanes{} + 1 / root;
      for (int r = j / 4 * 4; r < f.stride; r += 4) store(column + r, load(column + r) * scale);
      column[j] = root;
    }
  }
  return true;
}

FURROW_VECTOR_CLONES void square(const DenseFront& f, const double* side, int stride, double* update,
                                 int update_stride) {
  subtract_lower(update, update_stride, side, stride, update_stride, f.height - f.width, f.width);
}

FURROW_VECTOR_CLONES void forward(const DenseFront& f, double* x, double* below) {
  const int rest = f.height - f.width;
  for (int j = 0; j < f.width; ++j) {
    const double* column = f.panel + std::ptrdiff_t(j) * f.stride;
    x[j] /= column[j];
    for (int r = j + 1; r < f.width; ++r) x[r] -= column[r] * x[j];
    const double* side = column + f.width;
    const Lanes factor = Lanes{} + x[j];
    int r = 0;
    for (; r + 4 <= rest; r += 4) store(below + r, load(below + r) - factor * load(side + r));
    for (; r < rest; ++r) below[r] -= side[r] * x[j];
  }
}

FURROW_VECTOR_CLONES void backward(const DenseFront& f, double* x, const double* below) {
  const int rest = f.height - f.width;
  for (int j = f.width; j-- > 0;) {
    const double* column = f.panel + std::ptrdiff_t(j) * f.stride;
    const double* side = column + f.width;
    Lanes sums = {};
    int r = 0;
    for (; r + 4 <= rest; r += 4) sums += load(side + r) * load(below + r);
    double sum = (sums[0] + sums[1]) + (sums[2] + sums[3]);
    for (; r < rest; ++r) sum += side[r] * below[r];
    for (r = j + 1; r < f.width; ++r) sum += column[r] * x[r];
    x[j] = (x[j] - sum) / column[j];
  }
}

}  // namespace

bool eliminate(const DenseFront& front) { return eliminate_columns(front); }

void subtract_square(const DenseFront& f, double* update, int update_stride) {
  if (f.height > f.width) square(f, f.panel + f.width, f.stride, update, update_stride);
}

void substitute_forward(const DenseFront& factor, double* x, double* below) { forward(factor, x, below); }

void substitute_backward(const DenseFront& factor, double* x, const double* below) {
  backward(factor, x, below);
}

}  // namespace furrow::physics
