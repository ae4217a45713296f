// SPDX-License-Identifier: MIT
#include "physics/cloth/struts.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "physics/base/require.h"

namespace furrow::physics {
namespace {

using Neighbours = std::vector<std::vector<int>>;

void check(const Cloth& cloth, std::span<const int> patch, const StrutOptions& o) {
  const char* const operation = "add_struts";
  require(operation, "stiffness", o.stiffness, o.stiffness >= 0, ">= 0");
  if (o.nearest < 2) refuse(operation, "nearest = ", o.nearest, " is not >= 2");
  if (o.farthest < o.nearest) refuse(operation, "farthest = ", o.farthest, " is less than nearest");
  require(operation, "width", o.width, o.width >= 0, ">= 0");
  const auto n = int(cloth.particles.size());
  const auto in_range = [&](int i) {
    if (i < 0 || i >= n) refuse(operation, "no particle ", i, " among ", n);
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

/// The search for the particles that one is joined to.
class StrutSearch {
 public:
  StrutSearch(const Cloth& cloth, std::span<const int> patch, const StrutOptions& options)
      : p_(cloth.particles),
        o_(options),
        next_(neighbours_of(cloth)),
        ring_(p_.size(), -1),
        post_(p_.size()) {
    for (const int i : patch) post_[i] = 1;
    if (o_.width > 0) thin_out();
  }

  std::vector<Spring> struts() {
    std::vector<Spring> list;
    for (int a = 0; a < int(p_.size()); ++a) {
      if (!post_[a]) continue;
      const std::vector<int> reached = around(a, o_.farthest, o_.width / 2);
      for (const int b : reached)
        if (b > a && post_[b] && far_enough(a, b) && (p_.inv_mass[a] > 0 || p_.inv_mass[b] > 0))
          list.push_back({a, b, distance(a, b), o_.stiffness});
      for (const int b : reached) ring_[b] = -1;
    }
    return list;
  }

 private:
  double distance(int a, int b) const { return (p_.x[b] - p_.x[a]).norm(); }
  /// In rings and, where a mesh is finer than the width asks for, in length.
  bool far_enough(int a, int b) const { return ring_[b] >= o_.nearest && distance(a, b) >= o_.width / 4; }

  /// Particles within so many rings, and those that are joined to them within a length; ring_ tells how far.
  std::vector<int> around(int a, int rings, double length) {
    std::vector<int> reached{a};
    ring_[a] = 0;
    for (std::size_t r = 0; r < reached.size(); ++r)
      for (const int c : next_[reached[r]]) {
        const int ring = ring_[reached[r]] + 1;
        if (ring_[c] >= 0 || (ring > rings && distance(a, c) >= length)) continue;
        ring_[c] = ring;
        reached.push_back(c);
      }
    return reached;
  }

  /// Leaves a particle without struts where one of a lower index is closer than an eighth of the width.
  void thin_out() {
    for (int a = 0; a < int(p_.size()); ++a) {
      if (!post_[a]) continue;
      const std::vector<int> reached = around(a, 0, o_.width / 8);
      for (const int b : reached) {
        if (b > a && distance(a, b) < o_.width / 8) post_[b] = 0;
        ring_[b] = -1;
      }
    }
  }

  const Particles& p_;
  const StrutOptions& o_;
  Neighbours next_;
  std::vector<int> ring_;
  std::vector<char> post_;  ///< whether a particle gets struts
};

bool before(const Spring& s, const Spring& t) { return std::tie(s.a, s.b) < std::tie(t.a, t.b); }

}  // namespace

int add_struts(Cloth& cloth, std::span<const int> patch, const StrutOptions& o) {
  check(cloth, patch, o);
  std::vector<Spring> struts = StrutSearch(cloth, patch, o).struts();
  std::erase_if(struts, [&](const Spring& s) {
    return std::binary_search(cloth.bending.begin(), cloth.bending.end(), s, before);
  });
  cloth.bending.insert(cloth.bending.end(), struts.begin(), struts.end());
  std::sort(cloth.bending.begin(), cloth.bending.end(), before);
  return int(struts.size());
}

}  // namespace furrow::physics
