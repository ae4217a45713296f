// SPDX-License-Identifier: MIT
#include "physics/linear/dense_front.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "physics/linear/dense_kernels.h"

namespace furrow::physics {
namespace {

constexpr int block = 64;                      // columns that are eliminated between two products
constexpr double least_shared_products = 1e6;  // multiplications that are worth waking threads

/// Calls work(from, to) on pieces of the rows [from, to), multiples of 8, of like work: where `triangle`, row
/// r costs r. Each row is computed alike whatever the pieces are.
template <class Work>
void share_rows(int from, int to, bool triangle, double multiplications, ThreadPool* pool, Work work) {
  if (from >= to) return;
  if (!pool || pool->threads() == 1 || multiplications < least_shared_products) return work(from, to);
  const int pieces = 3 * pool->threads();
  const auto row = [&](int piece) {
    const double share = double(piece) / pieces;
    return piece == pieces ? to : from + int((to - from) * (triangle ? std::sqrt(share) : share)) / 8 * 8;
  };
  pool->share(pieces, [&](int piece, int) {
    if (row(piece) < row(piece + 1)) work(row(piece), row(piece + 1));
  });
}

}  // namespace

bool eliminate(const DenseFront& f, ThreadPool* pool) {
  const DenseKernels& kernels = dense_kernels();
  for (int o = 0; o < f.width; o += block) {
    const int columns = std::min(block, f.width - o), square = padded(columns), rows = f.stride - o;
    double* own = f.panel + std::ptrdiff_t(o) * f.stride + o;
    DenseProduct product{own, f.stride, f.panel + o, f.stride, 0, square, columns, o};
    if (o > 0) kernels.product(product);
    if (!kernels.factorise(own, f.stride, columns, square)) return false;
    const double work = double(rows - square) * columns * (o + columns / 2);
    share_rows(square, rows, false, work, pool, [&](int from, int to) {
      DenseProduct part = product;
      part.from = from, part.to = to;
      if (o > 0) kernels.product(part);
      kernels.solve_rows(own, f.stride, columns, from, to);
    });
  }
  return true;
}

void negative_square(const DenseFront& f, double* update, int update_stride, ThreadPool* pool) {
  const int rest = f.height - f.width;
  const double work = 0.5 * rest * rest * f.width;
  share_rows(0, update_stride, true, work, pool, [&](int from, int to) {
    dense_kernels().product(
        {update, update_stride, f.panel + f.width, f.stride, from, to, rest, f.width, true});
  });
}

void substitute_forward(const DenseFront& f, double* x) {
  dense_kernels().forward(f.panel, f.stride, f.width, x);
}

void substitute_backward(const DenseFront& f, double* x) {
  dense_kernels().backward(f.panel, f.stride, f.width, x);
}

}  // namespace furrow::physics
