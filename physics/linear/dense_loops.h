// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "physics/linear/dense_kernels.h"
#include "physics/linear/dense_tiles.h"

/// What dense_kernels.cpp compiles for each kind of processor, on vectors V; see DenseKernels. Every entry is
/// the same sequence of operations for each V.
namespace furrow::physics::dense {

/// Columns that are eliminated at once, their coefficients in registers.
template <class Real>
constexpr int group_of = line_of<Real>;

/// Columns [0, count) of the rows r of `a` over the factor's square: X = A L^-T.
template <class V>
FURROW_INLINE void solve_group(RealOf<V>* a, int stride, int count, int from, int to) {
  using Real = RealOf<V>;
  constexpr int group = group_of<Real>;
  Real factor[group][group] = {}, inverse[group] = {};
  for (int c = 0; c < count; ++c) {
    inverse[c] = 1 / a[c + std::ptrdiff_t(c) * stride];
    for (int i = 0; i < c; ++i) factor[c][i] = a[c + std::ptrdiff_t(i) * stride];
  }
  for (int r = from; r < to; r += lanes<V>) {
    V x[group];
#pragma GCC unroll 16
    for (int c = 0; c < group; ++c) {
      x[c] = V{};
      if (c < count) load(x[c], a + r + std::ptrdiff_t(c) * stride);
#pragma GCC unroll 16
      for (int i = 0; i < c; ++i) x[c] -= x[i] * (factor[c][i] - V{});
      x[c] = x[c] * (inverse[c] - V{});
      if (c < count) store(a + r + std::ptrdiff_t(c) * stride, x[c]);
    }
  }
}

/// The group's own rows, a line of them.
template <class Real>
FURROW_INLINE bool factorise_group(Real* a, int stride, int count) {
  constexpr int group = group_of<Real>;
  for (int j = 0; j < count; ++j) {
    Real* column = a + std::ptrdiff_t(j) * stride;
    for (int i = 0; i < j; ++i) {
      const Real* done = a + std::ptrdiff_t(i) * stride;
      for (int r = j; r < group; ++r) column[r] -= done[r] * done[j];
    }
    if (!(column[j] > 0) || !std::isfinite(column[j])) return false;
    column[j] = std::sqrt(column[j]);
    const Real inverse = 1 / column[j];
    for (int r = j + 1; r < group; ++r) column[r] *= inverse;
  }
  return true;
}

template <class V>
FURROW_INLINE bool factorise(RealOf<V>* a, int stride, int columns, int rows) {
  constexpr int group = group_of<RealOf<V>>;
  for (int k = 0; k < columns; k += group) {
    const int count = std::min(group, columns - k);
    RealOf<V>* own = a + std::ptrdiff_t(k) * stride + k;
    if (k > 0) shallow<V>({own, stride, a + k, stride, 0, rows - k, count, k});
    if (!factorise_group(own, stride, count)) return false;
    solve_group<V>(own, stride, count, group, rows - k);
  }
  return true;
}

template <class V>
FURROW_INLINE void solve_rows(RealOf<V>* a, int stride, int columns, int from, int to) {
  constexpr int group = group_of<RealOf<V>>;
  constexpr int piece = 96;  // rows that stay in the cache
  for (int r = from; r < to; r += piece) {
    const int end = std::min(r + piece, to);
    for (int k = 0; k < columns; k += group) {
      const int count = std::min(group, columns - k);
      RealOf<V>* own = a + std::ptrdiff_t(k) * stride + k;
      if (k > 0) shallow<V>({own, stride, a + k, stride, r - k, end - k, count, k});
      solve_group<V>(own, stride, count, r - k, end - k);
    }
  }
}

/// Columns and factors of a group; what it lacks is a column once more, times 0.
template <class Real>
struct Group {
  const Real* column[group_of<Real>];
  Real factor[group_of<Real>];
};

template <class V>
FURROW_INLINE void forward(const RealOf<V>* a, int stride, int columns, RealOf<V>* x) {
  constexpr int group = group_of<RealOf<V>>;
  for (int k = 0; k < columns; k += group) {
    const int count = std::min(group, columns - k);
    Group<RealOf<V>> g;
#pragma GCC unroll 16
    for (int j = 0; j < group; ++j) {
      g.column[j] = a + std::ptrdiff_t(j < count ? k + j : k) * stride;
      g.factor[j] = 0;
      if (j >= count) continue;
      g.factor[j] = x[k + j] /= g.column[j][k + j];
      for (int r = j + 1; r < group; ++r) x[k + r] -= g.column[j][k + r] * x[k + j];
    }
    for (int r = k + group; r < stride; r += lanes<V>) {
      V left;
      load(left, x + r);
#pragma GCC unroll 16
      for (int j = 0; j < group; ++j) {
        V v;
        load(v, g.column[j] + r);
        left -= v * (g.factor[j] - V{});
      }
      store(x + r, left);
    }
  }
}

/// One column's sum over whole lines of rows, in as many parts as a line has, whatever V is.
template <class V>
FURROW_INLINE void backward(const RealOf<V>* a, int stride, int columns, RealOf<V>* x) {
  using Real = RealOf<V>;
  constexpr int group = group_of<Real>, parts = group / lanes<V>, together = 4;
  for (int k = (columns - 1) / group * group; k >= 0; k -= group) {
    const int count = std::min(group, columns - k);
    Real sum[group] = {};
    for (int half = 0; half < count; half += together) {
      const Real* column[together];
      V sums[together][parts] = {};
      for (int j = 0; j < together; ++j)
        column[j] = a + std::ptrdiff_t(std::min(k + half + j, columns - 1)) * stride;
      for (int r = k + group; r < stride; r += group) {
#pragma GCC unroll 4
        for (int p = 0; p < parts; ++p) {
          V v;
          load(v, x + r + p * lanes<V>);
#pragma GCC unroll 4
          for (int j = 0; j < together; ++j) {
            V w;
            load(w, column[j] + r + p * lanes<V>);
            sums[j][p] += v * w;
          }
        }
      }
      for (int j = 0; j < together; ++j) {
        Real part[group];
        std::memcpy(part, sums[j], sizeof part);
        for (int n = 1; n < group; n *= 2)
          for (int i = 0; i < group; i += 2 * n) part[i] += part[i + n];
        sum[half + j] = part[0];
      }
    }
    for (int j = count; j-- > 0;) {
      const Real* column = a + std::ptrdiff_t(k + j) * stride + k;
      for (int r = j + 1; r < group; ++r) sum[j] += column[r] * x[k + r];
      x[k + j] = (x[k + j] - sum[j]) / column[j];
    }
  }
}

}  // namespace furrow::physics::dense
