// SPDX-License-Identifier: MIT
#include "physics/cloth/elements.h"

#include <algorithm>

#include "physics/base/require.h"
#include "physics/cloth/cloth.h"
#include "physics/cloth/kinds.h"

namespace furrow::physics {

void check_elements(const Cloth& cloth, std::size_t particles) {
  for_each_kind(cloth, [&](const auto& elements, auto...) {
    for (const auto& e : elements) check(e, particles);
  });
  for (const auto& own : cloth.energies)
    if (!own) refuse("cloth", "one of its energies is null");
}

double potential_energy(const Cloth& cloth, std::span<const Vec3> x) {
  check_elements(cloth, x.size());
  double sum = 0;
  for_each_kind(cloth, [&](const auto& elements, auto... law) {
    double of_kind = 0;
    for (const auto& e : elements) of_kind += energy(x, e, law...);
    sum += of_kind;
  });
  for (const auto& own : cloth.energies) sum += own->energy(x);
  return sum;
}

void add_forces(const Cloth& cloth, std::span<const Vec3> x, std::span<Vec3> force) {
  if (force.size() != x.size())
    refuse("add_forces", x.size(), " positions, but an array of ", force.size(), " forces");
  check_elements(cloth, x.size());
  for_each_kind(cloth, [&](const auto& elements, auto... law) {
    for (const auto& e : elements) add_forces(x, e, law..., force);
  });
  for (const auto& own : cloth.energies) own->add_forces(x, force);
}

void add_stiffness(const Cloth& cloth, std::span<const Vec3> x, Stiffness stiffness, const BlockSink& sink) {
  check_elements(cloth, x.size());
  for_each_kind(cloth, [&](const auto& elements, auto... law) {
    for (const auto& e : elements) {
      const auto particles = vertices(e);
      Mat3 lower[lower_blocks(int(particles.size()))];
      stiffness_blocks(x, e, law..., stiffness, lower);
      hand_out(particles, lower, sink);
    }
  });
  for (const auto& own : cloth.energies) own->add_stiffness(x, stiffness, sink);
}

bool has_all_stiffness(const Cloth& cloth) {
  return std::all_of(cloth.energies.begin(), cloth.energies.end(), [&](const auto& own) {
    return own->add_stiffness(cloth.particles.x, Stiffness::exact, [](int, int, const Mat3&) {});
  });
}

}  // namespace furrow::physics
