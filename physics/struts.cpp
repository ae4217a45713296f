// SPDX-License-Identifier: MIT
#include "physics/struts.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>

namespace furrow::physics {
namespace {

using Neighbours = std::vector<std::vector<int>>;

void check(const Cloth& cloth, std::span<const int> patch, const StrutOptions& o) {
  const auto fail = [](const std::string& what) { throw std::invalid_argument("add_struts: " + what); };
  if (!(o.stiffness >= 0) || !std::isfinite(o.stiffness))
    fail("stiffness = " + std::to_string(o.stiffness) + " is not >= 0");
  if (o.nearest < 2) fail("nearest = " + std::to_string(o.nearest) + " is not >= 2");
  if (o.farthest < o.nearest) fail("farthest = " + std::to_string(o.farthest) + " is less than nearest");
  const auto n = int(cloth.particles.size());
  const auto in_range = [&](int i) {
    if (i < 0 || i >= n) fail("no particle " + std::to_string(i) + " among " + std::to_string(n));
  };
  for (const int i : patch) in_range(i);
  for (const auto& t : cloth.triangles)
    for (const int i : t) in_range(i);
}

Neighbours neighbours_of(const Cloth& cloth) {
  Neighbours next(cloth.particles.size());
  for (const auto& t : cloth.triangles)
    for (int c = 0; c < 3; ++c) {
      next[t[c]].push_back(t[(c + 1) % 3]);
      next[t[c]].push_back(t[(c + 2) % 3]);
    }
  for (auto& list : next) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return next;
}

bool before(const Spring& s, const Spring& t) { return std::tie(s.a, s.b) < std::tie(t.a, t.b); }

}  // namespace

int add_struts(Cloth& cloth, std::span<const int> patch, const StrutOptions& o) {
  check(cloth, patch, o);
  const Particles& p = cloth.particles;
  const Neighbours next = neighbours_of(cloth);
  std::vector<int> ring(p.size(), -1), inside(p.size(), 0);
  for (const int i : patch) inside[i] = 1;
  std::vector<Spring> struts;
  for (int a = 0; a < int(p.size()); ++a) {
    if (!inside[a]) continue;
    std::vector<int> reached{a};
    ring[a] = 0;
    for (std::size_t r = 0; r < reached.size(); ++r) {
      const int b = reached[r];
      if (ring[b] >= o.nearest && b > a && inside[b] && (p.inv_mass[a] > 0 || p.inv_mass[b] > 0))
        struts.push_back({a, b, (p.x[b] - p.x[a]).norm(), o.stiffness});
      if (ring[b] == o.farthest) continue;
      for (const int c : next[b]) {
        if (ring[c] >= 0) continue;
        ring[c] = ring[b] + 1;
        reached.push_back(c);
      }
    }
    for (const int b : reached) ring[b] = -1;
  }
  std::erase_if(struts, [&](const Spring& s) {
    return std::binary_search(cloth.bending.begin(), cloth.bending.end(), s, before);
  });
  cloth.bending.insert(cloth.bending.end(), struts.begin(), struts.end());
  std::sort(cloth.bending.begin(), cloth.bending.end(), before);
  return int(struts.size());
}

}  // namespace furrow::physics
