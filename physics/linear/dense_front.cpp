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

/// Calls work(from, to) on pieces of the rows [from, to), multiples of a line, of like work: where
/// `triangle`, row r costs r. Each row is computed alike whatever the pieces are.
template <int line, class Work>
void share_rows(int from, int to, bool triangle, double multiplications, ThreadPool* pool, Work work) {
  if (from >= to) return;
  if (!pool || pool->threads() == 1 || multiplications < least_shared_products) return work(from, to);
  const int pieces = 3 * pool->threads();
  const auto row = [&](int piece) {
    const double share = double(piece) / pieces;
    return piece == pieces ? to
                           : from + int((to - from) * (triangle ? std::sqrt(share) : share)) / line * line;
  };
  pool->share(pieces, [&](int piece, int) {
    if (row(piece) < row(piece + 1)) work(row(piece), row(piece + 1));
  });
}

}  // namespace

template <class Real>
bool eliminate(const FrontOf<Real>& f, ThreadPool* pool) {
  const KernelsOf<Real>& kernels = dense_kernels<Real>();
  for (int o = 0; o < f.width; o += block) {
    const int columns = std::min(block, f.width - o), square = padded<Real>(columns), rows = f.stride - o;
    Real* own = f.panel + std::ptrdiff_t(o) * f.stride + o;
    ProductOf<Real> product{own, f.stride, f.panel + o, f.stride, 0, square, columns, o};
    if (o > 0) kernels.product(product);
    if (!kernels.factorise(own, f.stride, columns, square)) return false;
    const double work = double(rows - square) * columns * (o + columns / 2);
    share_rows<line_of<Real>>(square, rows, false, work, pool, [&](int from, int to) {
      ProductOf<Real> part = product;
      part.from = from, part.to = to;
      if (o > 0) kernels.product(part);
      kernels.solve_rows(own, f.stride, columns, from, to);
    });
  }
  return true;
}

template <class Real>
void negative_square(const FrontOf<Real>& f, Real* update, int update_stride, ThreadPool* pool) {
  const int rest = f.height - f.width;
  const double work = 0.5 * rest * rest * f.width;
  share_rows<line_of<Real>>(0, update_stride, true, work, pool, [&](int from, int to) {
    dense_kernels<Real>().product(
        {update, update_stride, f.panel + f.width, f.stride, from, to, rest, f.width, true});
  });
}

template <class Real>
void substitute_forward(const FrontOf<Real>& f, Real* x) {
  dense_kernels<Real>().forward(f.panel, f.stride, f.width, x);
}

template <class Real>
void substitute_backward(const FrontOf<Real>& f, Real* x) {
  dense_kernels<Real>().backward(f.panel, f.stride, f.width, x);
}

template bool eliminate(const FrontOf<float>&, ThreadPool*);
template bool eliminate(const FrontOf<double>&, ThreadPool*);
template void negative_square(const FrontOf<float>&, float*, int, ThreadPool*);
template void negative_square(const FrontOf<double>&, double*, int, ThreadPool*);
template void substitute_forward(const FrontOf<float>&, float*);
template void substitute_forward(const FrontOf<double>&, double*);
template void substitute_backward(const FrontOf<float>&, float*);
template void substitute_backward(const FrontOf<double>&, double*);

}  // namespace furrow::physics
