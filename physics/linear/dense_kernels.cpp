// SPDX-License-Identifier: MIT
#include "physics/linear/dense_kernels.h"

#include <cstddef>

#include "physics/linear/dense_loops.h"

// Compiled with contraction: a product and the sum behind it are one operation where the target has it.
namespace furrow::physics {
namespace {

template <class Real, int count>
struct VectorOf {
  typedef Real type __attribute__((vector_size(count * sizeof(Real)), may_alias));
};
template <class Real, int bytes>
using Vector = typename VectorOf<Real, bytes / int(sizeof(Real))>::type;

#define FURROW_KERNELS(name, bytes, target)                                                      \
  namespace name {                                                                               \
  template <class Real>                                                                          \
  target void product(const ProductOf<Real>& p) {                                                \
    dense::product<Vector<Real, bytes>>(p);                                                      \
  }                                                                                              \
  template <class Real>                                                                          \
  target bool factorise(Real* a, int stride, int columns, int rows) {                            \
    return dense::factorise<Vector<Real, bytes>>(a, stride, columns, rows);                      \
  }                                                                                              \
  template <class Real>                                                                          \
  target void solve_rows(Real* a, int stride, int columns, int from, int to) {                   \
    dense::solve_rows<Vector<Real, bytes>>(a, stride, columns, from, to);                        \
  }                                                                                              \
  template <class Real>                                                                          \
  target void forward(const Real* a, int stride, int columns, Real* x) {                         \
    dense::forward<Vector<Real, bytes>>(a, stride, columns, x);                                  \
  }                                                                                              \
  template <class Real>                                                                          \
  target void backward(const Real* a, int stride, int columns, Real* x) {                        \
    dense::backward<Vector<Real, bytes>>(a, stride, columns, x);                                 \
  }                                                                                              \
  template <class Real>                                                                          \
  constexpr KernelsOf<Real> all{#name,         product<Real>, factorise<Real>, solve_rows<Real>, \
                                forward<Real>, backward<Real>};                                  \
  }

FURROW_KERNELS(plain, 16, )
#if defined(__x86_64__) && defined(__GNUC__)
FURROW_KERNELS(avx2, 32, __attribute__((target("avx2,fma"))))
FURROW_KERNELS(avx512, 64, __attribute__((target("avx512f,avx512dq,avx512vl,fma"))))
#endif

}  // namespace

template <class Real>
std::vector<const KernelsOf<Real>*> all_dense_kernels() {
  std::vector<const KernelsOf<Real>*> found;
#if defined(__x86_64__) && defined(__GNUC__)
  __builtin_cpu_init();
  const bool fma = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (fma && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl"))
    found.push_back(&avx512::all<Real>);
  if (fma) found.push_back(&avx2::all<Real>);
#endif
  found.push_back(&plain::all<Real>);
  return found;
}

template <class Real>
const KernelsOf<Real>& dense_kernels() {
  static const KernelsOf<Real>& best = *all_dense_kernels<Real>().front();
  return best;
}

template std::vector<const KernelsOf<float>*> all_dense_kernels<float>();
template std::vector<const KernelsOf<double>*> all_dense_kernels<double>();
template const KernelsOf<float>& dense_kernels<float>();
template const KernelsOf<double>& dense_kernels<double>();

}  // namespace furrow::physics
