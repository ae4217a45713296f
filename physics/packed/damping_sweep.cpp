// SPDX-License-Identifier: MIT
#include "physics/packed/damping_sweep.h"

#include <cmath>

#include "physics/base/lanes.h"

namespace furrow::physics {
namespace {

struct Sweep {
  const Vec4* x;
  Vec4* v;
  const int *a, *b;
  const double *inv_length2, *decay_a, *decay_b;
};

FURROW_INLINE void damp_one(const Sweep& s, int i) {
  const Lanes d = *(const Lanes*)(s.x + s.b[i]) - *(const Lanes*)(s.x + s.a[i]);
  Lanes* va = (Lanes*)(s.v + s.a[i]);
  Lanes* vb = (Lanes*)(s.v + s.b[i]);
  const Lanes p = d * (*vb - *va);
  const double r = ((p[0] + p[1]) + p[2]) * s.inv_length2[i];
  Lanes ja, jb;
  spread(s.decay_a[i] * r, ja);
  spread(s.decay_b[i] * r, jb);
  *va += ja * d;
  *vb -= jb * d;
}

/// Springs of one group share no particle, so four go at once.
FURROW_VECTOR_CLONES
void damp_group(const Sweep* sweep, int begin, int end) {
  const Sweep s = *sweep;
  int i = begin;
  for (; i + 4 <= end; i += 4) {
    Lanes d[4], p[4], r;
    for (int j = 0; j < 4; ++j) {
      d[j] = *(const Lanes*)(s.x + s.b[i + j]) - *(const Lanes*)(s.x + s.a[i + j]);
      p[j] = d[j] * (*(const Lanes*)(s.v + s.b[i + j]) - *(const Lanes*)(s.v + s.a[i + j]));
    }
    sum_xyz(p[0], p[1], p[2], p[3], r);
    for (int j = 0; j < 4; ++j) {
      const double along = r[j] * s.inv_length2[i + j];
      Lanes ja, jb;
      spread(s.decay_a[i + j] * along, ja);
      spread(s.decay_b[i + j] * along, jb);
      *(Lanes*)(s.v + s.a[i + j]) += ja * d[j];
      *(Lanes*)(s.v + s.b[i + j]) -= jb * d[j];
    }
  }
  for (; i < end; ++i) damp_one(s, i);
}

Sweep sweep_of(PackedCloth& p, const std::vector<double>& decay_a, const std::vector<double>& decay_b) {
  return {p.x.data(),           p.v.data(),     p.a.data(),    p.b.data(),
          p.inv_length2.data(), decay_a.data(), decay_b.data()};
}

void forward_groups(const PackedCloth& packed, const Sweep& sweep, int first, int last) {
  const std::vector<int>& begin = packed.sweep.group_begin;
  for (int g = first; g < last; ++g) damp_group(&sweep, begin[std::size_t(g)], begin[std::size_t(g) + 1]);
}

void reverse_groups(const PackedCloth& packed, const Sweep& sweep, int first, int last) {
  const std::vector<int>& begin = packed.sweep.group_begin;
  for (int g = last; g-- > first;) damp_group(&sweep, begin[std::size_t(g)], begin[std::size_t(g) + 1]);
}

}  // namespace

DampingSweep::DampingSweep(const PackedCloth& packed, double zeta, double seconds) {
  if (zeta == 0) return;
  for (std::size_t i = 0; i < packed.a.size(); ++i) {
    const double inv_a = packed.inv_mass[packed.a[i]], inv_b = packed.inv_mass[packed.b[i]],
                 inv = inv_a + inv_b;
    const double gamma = 2 * zeta * std::sqrt(packed.damping_k[i] * inv);
    const double share = inv > 0 ? -std::expm1(-gamma * seconds) / inv : 0;  // m (1 - exp(-gamma t))
    decay_a_.push_back(share * inv_a);
    decay_b_.push_back(share * inv_b);
  }
}

void DampingSweep::forward(PackedCloth& packed, ThreadPool& pool) const {
  if (decay_a_.empty()) return;
  const Sweep sweep = sweep_of(packed, decay_a_, decay_b_);
  const std::vector<int>& block = packed.sweep.block_begin;
  pool.run(packed.sweep.blocks(), [&](int begin, int end) {
    for (int i = begin; i < end; ++i)
      forward_groups(packed, sweep, block[std::size_t(i)], block[std::size_t(i) + 1]);
  });
  forward_groups(packed, sweep, block.back(), packed.sweep.groups());
}

void DampingSweep::reverse(PackedCloth& packed, ThreadPool& pool) const {
  if (decay_a_.empty()) return;
  const Sweep sweep = sweep_of(packed, decay_a_, decay_b_);
  const std::vector<int>& block = packed.sweep.block_begin;
  reverse_groups(packed, sweep, block.back(), packed.sweep.groups());
  pool.run(packed.sweep.blocks(), [&](int begin, int end) {
    for (int i = begin; i < end; ++i)
      reverse_groups(packed, sweep, block[std::size_t(i)], block[std::size_t(i) + 1]);
  });
}

}  // namespace furrow::physics
