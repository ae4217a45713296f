// SPDX-License-Identifier: MIT
#include "physics/linear/dense_kernels.h"

#include <cstddef>

#include "physics/linear/dense_loops.h"

// Compiled with contraction: a product and the sum behind it are one operation where the target has it.
namespace furrow::physics {
namespace {

typedef double Lanes2 __attribute__((vector_size(16), may_alias));
typedef double Lanes8 __attribute__((vector_size(64), may_alias));

#define FURROW_KERNELS(name, V, target)                                                 \
  namespace name {                                                                      \
  target void product(const DenseProduct& p) { dense::product<V>(p); }                  \
  target bool factorise(double* a, int stride, int columns, int rows) {                 \
    return dense::factorise<V>(a, stride, columns, rows);                               \
  }                                                                                     \
  target void solve_rows(double* a, int stride, int columns, int from, int to) {        \
    dense::solve_rows<V>(a, stride, columns, from, to);                                 \
  }                                                                                     \
  target void forward(const double* a, int stride, int columns, double* x) {            \
    dense::forward<V>(a, stride, columns, x);                                           \
  }                                                                                     \
  target void backward(const double* a, int stride, int columns, double* x) {           \
    dense::backward<V>(a, stride, columns, x);                                          \
  }                                                                                     \
  constexpr DenseKernels all{#name, product, factorise, solve_rows, forward, backward}; \
  }

FURROW_KERNELS(plain, Lanes2, )
#if defined(__x86_64__) && defined(__GNUC__)
FURROW_KERNELS(avx2, Lanes, __attribute__((target("avx2,fma"))))
FURROW_KERNELS(avx512, Lanes8, __attribute__((target("avx512f,avx512dq,avx512vl,fma"))))
#endif

}  // namespace

std::vector<const DenseKernels*> all_dense_kernels() {
  std::vector<const DenseKernels*> found;
#if defined(__x86_64__) && defined(__GNUC__)
  __builtin_cpu_init();
  const bool fma = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (fma && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl"))
    found.push_back(&avx512::all);
  if (fma) found.push_back(&avx2::all);
#endif
  found.push_back(&plain::all);
  return found;
}

const DenseKernels& dense_kernels() {
  static const DenseKernels& best = *all_dense_kernels().front();
  return best;
}

}  // namespace furrow::physics
