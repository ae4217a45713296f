// SPDX-License-Identifier: MIT
#include "physics/motion/strain_watch.h"

namespace furrow::physics {

StrainWatch::StrainWatch(const Cloth& cloth, const PackedCloth& packed) : edges_(measured_edges(cloth)) {
  std::vector<int> place(packed.particle.size());
  for (std::size_t i = 0; i < place.size(); ++i) place[std::size_t(packed.particle[i])] = int(i);
  for (Spring& e : edges_) {
    e.a = place[std::size_t(e.a)];
    e.b = place[std::size_t(e.b)];
  }
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
