// SPDX-License-Identifier: MIT
#include "physics/packed/dashpots.h"

#include <algorithm>
#include <cmath>

#include "physics/base/lanes.h"

namespace furrow::physics {
namespace {

double dashpot(double k, double inv_a, double inv_b, double zeta) {
  const double inv = inv_a + inv_b;
  return inv > 0 ? 2 * zeta * std::sqrt(k / inv) : 0;
}

void resist(PackedCloth& cloth, const std::vector<double>& c, int begin, int end) {
  for (int i = begin; i < end; ++i) {
    const int a = cloth.a[i], b = cloth.b[i];
    const Lanes d = *(const Lanes*)&cloth.x[b] - *(const Lanes*)&cloth.x[a];
    const Lanes p = d * (*(const Lanes*)&cloth.v[b] - *(const Lanes*)&cloth.v[a]);
    Lanes t;
    spread(c[i] * cloth.inv_length2[i] * ((p[0] + p[1]) + p[2]), t);
    *(Lanes*)&cloth.force[a] += t * d;
    *(Lanes*)&cloth.force[b] -= t * d;
  }
}

}  // namespace

std::vector<double> dashpots(const PackedCloth& cloth, double zeta) {
  std::vector<double> c;
  if (zeta == 0) return c;
  for (std::size_t i = 0; i < cloth.a.size(); ++i)
    c.push_back(dashpot(cloth.damping_k[i], cloth.inv_mass[cloth.a[i]], cloth.inv_mass[cloth.b[i]], zeta));
  return c;
}

void add_dashpot_forces(PackedCloth& cloth, const std::vector<double>& c, ThreadPool& pool) {
  if (c.empty()) return;
  const std::vector<int>&group = cloth.sweep.group_begin, &block = cloth.sweep.block_begin;
  pool.run(cloth.sweep.blocks(), [&](int begin, int end) {
    resist(cloth, c, group[std::size_t(block[std::size_t(begin)])],
           group[std::size_t(block[std::size_t(end)])]);
  });
  resist(cloth, c, group[std::size_t(block.back())], group.back());
}

double fastest_decay(const PackedCloth& cloth, const std::vector<double>& c) {
  std::vector<double> rows(cloth.inv_mass.size(), 0.0);
  for (std::size_t i = 0; i < c.size(); ++i) {
    const auto a = std::size_t(cloth.a[i]), b = std::size_t(cloth.b[i]);
    const double inv_a = cloth.inv_mass[a], inv_b = cloth.inv_mass[b];
    rows[a] += inv_a * (inv_b > 0 ? 2 : 1) * c[i];
    rows[b] += inv_b * (inv_a > 0 ? 2 : 1) * c[i];
  }
  return rows.empty() ? 0 : *std::max_element(rows.begin(), rows.end());
}

}  // namespace furrow::physics
