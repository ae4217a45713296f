// SPDX-License-Identifier: MIT
#include "physics/packed/packed_forces.h"

#include <algorithm>
#include <cmath>

#include "physics/base/lanes.h"

namespace furrow::physics {
namespace {

constexpr double least_l2 = 1e-280;  // m^2

struct Springs {
  const Vec4* x;
  const int *a, *b;
  const double *k, *kL;
  double* inv_length2;
  Vec4* force;
};

FURROW_INLINE void pull(const Springs& s, int i, double tension, const Lanes& d) {
  Lanes t;
  spread(tension, t);
  *(Lanes*)(s.force + s.a[i]) += t * d;
  *(Lanes*)(s.force + s.b[i]) -= t * d;
}

/// Springs of one group share no particle, so four go at once.
FURROW_VECTOR_CLONES
void pull_group(const Springs* springs, int begin, int end) {
  const Springs s = *springs;
  int i = begin;
  for (; i + 4 <= end; i += 4) {
    Lanes d[4], l2;
    for (int j = 0; j < 4; ++j) d[j] = *(const Lanes*)(s.x + s.b[i + j]) - *(const Lanes*)(s.x + s.a[i + j]);
    sum_xyz(d[0] * d[0], d[1] * d[1], d[2] * d[2], d[3] * d[3], l2);
    Lanes root;
    for (int j = 0; j < 4; ++j) root[j] = std::sqrt(std::max(l2[j], least_l2));
    const Lanes one = {1, 1, 1, 1}, inv = one / root;
    const Lanes tension = at(s.k + i) - at(s.kL + i) * inv;
    *(UnalignedLanes*)(s.inv_length2 + i) = inv * inv;
    for (int j = 0; j < 4; ++j) pull(s, i + j, tension[j], d[j]);
  }
  for (; i < end; ++i) {
    const Lanes d = *(const Lanes*)(s.x + s.b[i]) - *(const Lanes*)(s.x + s.a[i]), p = d * d;
    const double inv = 1 / std::sqrt(std::max((p[0] + p[1]) + p[2], least_l2));
    s.inv_length2[i] = inv * inv;
    pull(s, i, s.k[i] - s.kL[i] * inv, d);
  }
}

}  // namespace

void update_spring_forces(PackedCloth& packed, ThreadPool& pool) {
  std::fill(packed.force.begin(), packed.force.end(), Vec4{});
  const Springs springs{packed.x.data(),  packed.a.data(),           packed.b.data(),    packed.k.data(),
                        packed.kL.data(), packed.inv_length2.data(), packed.force.data()};
  const std::vector<int>&group = packed.sweep.group_begin, &block = packed.sweep.block_begin;
  const auto pull_groups = [&](int first, int last) {
    for (int g = first; g < last; ++g) pull_group(&springs, group[std::size_t(g)], group[std::size_t(g) + 1]);
  };
  pool.run(packed.sweep.blocks(), [&](int begin, int end) {
    for (int i = begin; i < end; ++i) pull_groups(block[std::size_t(i)], block[std::size_t(i) + 1]);
  });
  pull_groups(block.back(), packed.sweep.groups());
}

}  // namespace furrow::physics
