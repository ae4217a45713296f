// SPDX-License-Identifier: MIT
#include "physics/dense_front.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <vector>

#include "physics/lanes.h"

namespace furrow::physics {
namespace {

constexpr int outer = 64, inner = 8;  // columns that are eliminated between two products
// Pieces of a product that stay in the caches: rows and columns of the result, depth.
constexpr int piece_rows = 96, piece_columns = 256, piece_depth = 192;
constexpr int least_depth = 24;  // below that copying does not pay
constexpr int shared_pieces = 8;
constexpr double least_shared = 2e6;  // multiplications that are worth waking threads

FURROW_INLINE void load(Lanes& v, const double* p) { std::memcpy(&v, p, sizeof v); }
FURROW_INLINE void store(double* p, const Lanes& v) { std::memcpy(p, &v, sizeof v); }
FURROW_INLINE void subtract(double* p, const Lanes& v) {
  Lanes old;
  load(old, p);
  store(p, old - v);
}

/// c (4 `Tall` rows x `Wide` columns) -= a b^T over `depth` columns of a and b.
template <int Tall, int Wide>
FURROW_INLINE void subtract_tile(double* c, int c_stride, const double* a, const double* b, int a_stride,
                                 int b_stride, int depth) {
  Lanes sum[Tall][Wide] = {};
  for (int k = 0; k < depth; ++k, a += a_stride, b += b_stride) {
    Lanes rows[Tall];
#pragma GCC unroll 3
    for (int t = 0; t < Tall; ++t) load(rows[t], a + 4 * t);
#pragma GCC unroll 4
    for (int w = 0; w < Wide; ++w) {
      const Lanes factor = Lanes{} + b[w];
#pragma GCC unroll 3
      for (int t = 0; t < Tall; ++t) sum[t][w] += rows[t] * factor;
    }
  }
#pragma GCC unroll 4
  for (int w = 0; w < Wide; ++w)
#pragma GCC unroll 3
    for (int t = 0; t < Tall; ++t) subtract(c + w * c_stride + 4 * t, sum[t][w]);
}

/// Rows and columns of a product: c -= a b^T on and below the diagonal, where c's row i and column i are
/// those of a's row i, and b is a. Of c the rows [from, to), multiples of 4, and `columns` columns.
struct Product {
  double* c;
  int c_stride;
  const double* a;
  int stride, from, to, columns, depth;
};

/// In place, for little depth.
FURROW_INLINE void subtract_shallow(const Product& p) {
  int j = 0;
  for (; j + 4 <= p.columns; j += 4) {
    int r = std::max(j, p.from);
    double* column = p.c + std::ptrdiff_t(j) * p.c_stride;
    for (; r + 8 <= p.to; r += 8)
      subtract_tile<2, 4>(column + r, p.c_stride, p.a + r, p.a + j, p.stride, p.stride, p.depth);
    if (r < p.to) subtract_tile<1, 4>(column + r, p.c_stride, p.a + r, p.a + j, p.stride, p.stride, p.depth);
  }
  for (; j < p.columns; ++j)  // whole lanes; what is above the diagonal does not count
    for (int r = std::max(j / 4 * 4, p.from); r < p.to; r += 4)
      subtract_tile<1, 1>(p.c + r + std::ptrdiff_t(j) * p.c_stride, p.c_stride, p.a + r, p.a + j, p.stride,
                          p.stride, p.depth);
}

/// Rows [from, to) of a, tile by tile of `tall` rows (the last may be 8 or 4), each column after column.
FURROW_INLINE void copy_rows(const double* a, int stride, int from, int to, int depth, double* copy) {
  for (int r = from; r < to;) {
    const int tall = to - r >= 12 ? 12 : to - r >= 8 ? 8 : 4;
    for (int k = 0; k < depth; ++k, copy += tall)
      std::memcpy(copy, a + r + std::ptrdiff_t(k) * stride, std::size_t(tall) * sizeof(double));
    r += tall;
  }
}

/// The tiles of a piece: rows [from, to) of c, `columns` from c's column `first` on, of the copies.
FURROW_INLINE void subtract_copies(double* c, int c_stride, int from, int to, int first, int columns,
                                   const double* rows, const double* others, int depth) {
  for (int r = from; r < to;) {
    const int tall = to - r >= 12 ? 12 : to - r >= 8 ? 8 : 4;
    for (int j = 0; j < columns && first + j < r + tall; j += 4) {
      double* tile = c + r + std::ptrdiff_t(first + j) * c_stride;
      const double* b = others + std::ptrdiff_t(j) * depth;
      if (tall == 12)
        subtract_tile<3, 4>(tile, c_stride, rows, b, 12, 4, depth);
      else if (tall == 8)
        subtract_tile<2, 4>(tile, c_stride, rows, b, 8, 4, depth);
      else
        subtract_tile<1, 4>(tile, c_stride, rows, b, 4, 4, depth);
    }
    rows += std::ptrdiff_t(tall) * depth;
    r += tall;
  }
}

/// As subtract_shallow(), for any depth: by copies of pieces in the order in which they are read (Goto and
/// van de Geijn, Anatomy of high-performance matrix multiplication, ACM TOMS 34(3), 2008).
FURROW_VECTOR_CLONES void subtract_product(const Product& p) {
  if (p.depth < least_depth || p.columns < 4) return subtract_shallow(p);
  thread_local std::vector<double> own(std::size_t(piece_rows) * piece_depth),
      other(std::size_t(piece_columns) * piece_depth);
  const int whole = p.columns / 4 * 4;
  for (int k = 0; k < p.depth; k += piece_depth) {
    const int d = std::min(piece_depth, p.depth - k);
    const double* part = p.a + std::ptrdiff_t(k) * p.stride;
    for (int j = 0; j < std::min(whole, p.to); j += piece_columns) {
      const int wide = std::min(piece_columns, whole - j);
      for (int g = 0; g < wide; g += 4)
        copy_rows(part, p.stride, j + g, j + g + 4, d, other.data() + std::ptrdiff_t(g) * d);
      for (int r = std::max(j, p.from); r < p.to; r += piece_rows) {
        const int to = std::min(r + piece_rows, p.to);
        copy_rows(part, p.stride, r, to, d, own.data());
        subtract_copies(p.c, p.c_stride, r, to, j, wide, own.data(), other.data(), d);
      }
    }
  }
  for (int j = whole; j < p.columns; ++j)
    for (int r = std::max(j / 4 * 4, p.from); r < p.to; r += 4)
      subtract_tile<1, 1>(p.c + r + std::ptrdiff_t(j) * p.c_stride, p.c_stride, p.a + r, p.a + j, p.stride,
                          p.stride, p.depth);
}

/// All rows; by rows of like work where there are threads to share it. Each entry is computed alike.
void subtract_all(Product p, ThreadPool* pool) {
  const int rows = p.to;
  if (!pool || double(rows) * p.columns * p.depth < least_shared) return subtract_product(p);
  const auto row = [&](int piece) {
    const double share = double(piece) / shared_pieces;
    return piece == shared_pieces ? rows
                                  : int(rows * (p.columns < rows / 2 ? share : std::sqrt(share))) / 4 * 4;
  };
  pool->run(shared_pieces, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      Product part = p;
      part.from = row(i), part.to = row(i + 1);
      subtract_product(part);
    }
  });
}

/// column[from...stride) -= factor * other.
FURROW_INLINE void subtract_multiple(double* column, const double* other, double factor, int from,
                                     int stride) {
  const Lanes f = Lanes{} + factor;
  for (int r = from / 4 * 4; r < stride; r += 4) {
    Lanes v;
    load(v, other + r);
    subtract(column + r, f * v);
  }
}

/// Columns [k, end), to which nothing before k is owed any more.
FURROW_INLINE bool eliminate_block(const DenseFront& f, int k, int end) {
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
    for (int r = j / 4 * 4; r < f.stride; r += 4) {
      Lanes v;
      load(v, column + r);
      store(column + r, v * scale);
    }
    column[j] = root;
  }
  return true;
}

/// Columns [o, end), to which nothing before o is owed any more.
FURROW_VECTOR_CLONES bool eliminate_columns(const DenseFront& f, int o, int end) {
  const double* first = f.panel + std::ptrdiff_t(o) * f.stride;
  for (int k = o; k < end; k += inner) {
    const int last = std::min(k + inner, end);
    double* own = f.panel + std::ptrdiff_t(k) * f.stride + k;
    if (k > o) subtract_shallow({own, f.stride, first + k, f.stride, 0, f.stride - k, last - k, k - o});
    if (!eliminate_block(f, k, last)) return false;
  }
  return true;
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
    for (; r + 4 <= rest; r += 4) {
      Lanes v;
      load(v, side + r);
      subtract(below + r, factor * v);
    }
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
    for (; r + 4 <= rest; r += 4) {
      Lanes v, w;
      load(v, side + r);
      load(w, below + r);
      sums += v * w;
    }
    double sum = (sums[0] + sums[1]) + (sums[2] + sums[3]);
    for (; r < rest; ++r) sum += side[r] * below[r];
    for (r = j + 1; r < f.width; ++r) sum += column[r] * x[r];
    x[j] = (x[j] - sum) / column[j];
  }
}

}  // namespace

bool eliminate(const DenseFront& f, ThreadPool* pool) {
  for (int o = 0; o < f.width; o += outer) {
    const int end = std::min(o + outer, f.width);
    double* own = f.panel + std::ptrdiff_t(o) * f.stride + o;
    if (o > 0) subtract_all({own, f.stride, f.panel + o, f.stride, 0, f.stride - o, end - o, o}, pool);
    if (!eliminate_columns(f, o, end)) return false;
  }
  return true;
}

void subtract_square(const DenseFront& f, double* update, int update_stride, ThreadPool* pool) {
  if (f.height == f.width) return;
  subtract_all(
      {update, update_stride, f.panel + f.width, f.stride, 0, update_stride, f.height - f.width, f.width},
      pool);
}

void substitute_forward(const DenseFront& factor, double* x, double* below) { forward(factor, x, below); }

void substitute_backward(const DenseFront& factor, double* x, const double* below) {
  backward(factor, x, below);
}

}  // namespace furrow::physics
