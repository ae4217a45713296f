// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

#include "physics/base/lanes.h"
#include "physics/linear/dense_kernels.h"

/// Products for dense_loops.h, on vectors V: tiles of the result that stay in registers, and pieces that stay
/// in the caches (Goto and van de Geijn, Anatomy of high-performance matrix multiplication, ACM TOMS 34(3),
/// 2008).
namespace furrow::physics::dense {

template <class V>
using RealOf = std::remove_cvref_t<decltype(std::declval<V>()[0])>;
template <class V>
constexpr int lanes = int(sizeof(V) / sizeof(RealOf<V>));
template <class V>
constexpr int tall = 3 * lanes<V>;  // rows of a tile
constexpr int wide = 4;             // its columns
// Pieces: rows and columns of the result, depth.
constexpr int piece_rows = 96, piece_columns = 256, piece_depth = 192;
constexpr int least_depth = 24;  // below that copying does not pay

template <class V>
FURROW_INLINE void load(V& v, const RealOf<V>* p) {
  std::memcpy(&v, p, sizeof v);
}
template <class V>
FURROW_INLINE void store(RealOf<V>* p, const V& v) {
  std::memcpy(p, &v, sizeof v);
}

/// Rows and columns of c and what they are made of.
template <class Real>
struct Tile {
  Real* c;
  int c_stride;
  const Real *a, *b;
  int a_stride, b_stride, depth, columns;  // of at most 4
  bool fresh;
};

/// `Tall` vectors of rows.
template <class V, int Tall>
FURROW_INLINE void tile(const Tile<RealOf<V>>& t) {
  V sum[Tall][wide] = {};
  const RealOf<V>*a = t.a, *b = t.b;
  for (int k = 0; k < t.depth; ++k, a += t.a_stride, b += t.b_stride) {
    V rows[Tall];
#pragma GCC unroll 3
    for (int i = 0; i < Tall; ++i) load(rows[i], a + lanes<V> * i);
#pragma GCC unroll 4
    for (int w = 0; w < wide; ++w) {
      const V factor = b[w] - V{};
#pragma GCC unroll 3
      for (int i = 0; i < Tall; ++i) sum[i][w] += rows[i] * factor;
    }
  }
#pragma GCC unroll 4
  for (int w = 0; w < wide; ++w) {
    if (w >= t.columns) break;
#pragma GCC unroll 3
    for (int i = 0; i < Tall; ++i) {
      RealOf<V>* c = t.c + std::ptrdiff_t(w) * t.c_stride + lanes<V> * i;
      V old = {};
      if (!t.fresh) load(old, c);
      store(c, old - sum[i][w]);
    }
  }
}

template <class V>
FURROW_INLINE void tile_of(int rows, const Tile<RealOf<V>>& t) {
  if (rows >= tall<V>)
    tile<V, 3>(t);
  else if (rows >= 2 * lanes<V>)
    tile<V, 2>(t);
  else
    tile<V, 1>(t);
}

/// The first row of a tile that has something on or below the diagonal in column j.
template <class V>
FURROW_INLINE int first_row(int j) {
  return j / lanes<V> * lanes<V>;
}

/// In place, for little depth.
template <class V>
FURROW_INLINE void shallow(const ProductOf<RealOf<V>>& p) {
  for (int j = 0; j < p.columns; j += wide) {
    RealOf<V>* column = p.c + std::ptrdiff_t(j) * p.c_stride;
    for (int r = std::max(first_row<V>(j), p.from); r < p.to; r += tall<V>)
      tile_of<V>(p.to - r, {column + r, p.c_stride, p.a + r, p.a + j, p.stride, p.stride, p.depth,
                            std::min(wide, p.columns - j), p.fresh});
  }
}

/// Rows [from, to) of a, in strips of `Height`, each column after column.
template <int Height, class Real>
FURROW_INLINE void copy_rows(const Real* a, int stride, int from, int to, int depth, Real* copy) {
  for (int r = from; r < to; r += Height) {
    const Real* column = a + r;
    if (r + Height <= to) {
      for (int k = 0; k < depth; ++k, copy += Height, column += stride)
        std::memcpy(copy, column, Height * sizeof(Real));
    } else {
      for (int k = 0; k < depth; ++k, copy += Height, column += stride)
        for (int i = 0; i < to - r; ++i) copy[i] = column[i];
    }
  }
}

/// The tiles of a piece: p's rows, and of its columns `count` from the column `first` on; from copies.
template <class V>
FURROW_INLINE void copied(const ProductOf<RealOf<V>>& p, int first, int count, const RealOf<V>* rows,
                          const RealOf<V>* others) {
  for (int r = p.from; r < p.to; r += tall<V>, rows += std::ptrdiff_t(tall<V>) * p.depth) {
    const int end = std::min(r + tall<V>, p.to);
    for (int j = first; j < first + count && j < end; j += wide) {
      const int top = std::max(first_row<V>(j), r);
      tile_of<V>(end - top, {p.c + top + std::ptrdiff_t(j) * p.c_stride, p.c_stride, rows + (top - r),
                             others + std::ptrdiff_t(j - first) * p.depth, tall<V>, wide, p.depth,
                             std::min(wide, first + count - j), p.fresh});
    }
  }
}

template <class V>
FURROW_INLINE void product(const ProductOf<RealOf<V>>& p) {
  using Real = RealOf<V>;
  if (p.depth < least_depth || p.columns < wide) return shallow<V>(p);
  thread_local std::vector<Real> own(std::size_t(piece_rows) * piece_depth + tall<V>),
      other(std::size_t(piece_columns) * piece_depth);
  for (int k = 0; k < p.depth; k += piece_depth) {
    ProductOf<Real> part = p;
    part.a += std::ptrdiff_t(k) * p.stride;
    part.depth = std::min(piece_depth, p.depth - k);
    part.fresh = p.fresh && k == 0;
    for (int j = 0; j < std::min(p.columns, p.to); j += piece_columns) {
      const int count = std::min(piece_columns, p.columns - j);
      copy_rows<wide>(part.a, p.stride, j, j + count, part.depth, other.data());
      for (int r = std::max(j, p.from); r < p.to; r += piece_rows) {
        part.from = r, part.to = std::min(r + piece_rows, p.to);
        copy_rows<tall<V>>(part.a, p.stride, part.from, part.to, part.depth, own.data());
        copied<V>(part, j, count, own.data(), other.data());
      }
    }
  }
}

}  // namespace furrow::physics::dense
