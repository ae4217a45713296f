// SPDX-License-Identifier: MIT
#include "physics/motion/strain_watch.h"

#include <algorithm>
#include <tuple>

namespace furrow::physics {

StrainWatch::StrainWatch(const Cloth& cloth, const PackedCloth& packed) : edges_(measured_edges(cloth)) {
  std::vector<int> place(packed.particle.size());
  for (std::size_t i = 0; i < place.size(); ++i) place[std::size_t(packed.particle[i])] = int(i);
  for (Spring& e : edges_) {
    const auto [a, b] = std::minmax(place[std::size_t(e.a)], place[std::size_t(e.b)]);
    e.a = a;
    e.b = b;
  }
  const auto ends = [](const Spring& e) { return std::tie(e.a, e.b); };
  std::ranges::stable_sort(edges_, {}, ends);
  edges_.erase(std::ranges::unique(edges_, {}, ends).begin(), edges_.end());
}

LongestEdge StrainWatch::look(const PackedCloth& packed, double time, const LongestEdge& known) const {
  LongestEdge longest = known;
  for (const Spring& e : edges_) {
    const Vec3 a = xyz(packed.x[std::size_t(e.a)]), b = xyz(packed.x[std::size_t(e.b)]);
    const double strain = (b - a).norm() / e.rest_length - 1;
    if (strain > longest.strain) longest = {strain, time, 0.5 * (a + b)};
  }
  return longest;
}

}  // namespace furrow::physics
