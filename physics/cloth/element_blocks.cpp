// SPDX-License-Identifier: MIT
#include "physics/cloth/element_blocks.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "physics/cloth/elements.h"
#include "physics/cloth/hinge_forces.h"
#include "physics/cloth/membrane.h"
#include "physics/cloth/spring_forces.h"
#include "physics/cloth/tension_forces.h"

namespace furrow::physics {
namespace {

std::array<int, 2> particles_of(const Spring& s) { return {s.a, s.b}; }
std::array<int, 2> particles_of(const Tension& t) { return {t.a, t.b}; }
std::array<int, 3> particles_of(const MembraneTriangle& t) { return t.vertices; }
std::array<int, 4> particles_of(const Hinge& h) { return h.vertices; }

/// Calls visit on each element of [begin, end).
template <class Visit>
void for_elements(const Cloth& cloth, int begin, int end, Visit visit) {
  const auto pass = [&](const auto& kind) {
    const int n = int(kind.size());
    for (int i = std::max(begin, 0); i < std::min(end, n); ++i) visit(kind[std::size_t(i)]);
    begin -= n, end -= n;
  };
  pass(cloth.structural);
  pass(cloth.bending);
  pass(cloth.membrane);
  pass(cloth.tension);
  pass(cloth.hinges);
}

}  // namespace

std::array<int, 5> count_elements(const Cloth& cloth) {
  return {int(cloth.structural.size()), int(cloth.bending.size()), int(cloth.membrane.size()),
          int(cloth.tension.size()), int(cloth.hinges.size())};
}

int first_block(const std::array<int, 5>& counts, int element) {
  constexpr std::array particles{2, 2, 3, 2, 4};
  int blocks = 0;
  for (std::size_t kind = 0; kind < counts.size(); ++kind) {
    const int before = std::clamp(element, 0, counts[kind]);
    blocks += before * lower_blocks(particles[kind]);
    element -= before;
  }
  return blocks;
}

std::vector<std::array<int, 2>> block_pairs(const Cloth& cloth) {
  potential_energy(cloth, cloth.particles.x);  // throws what add_stiffness() would
  std::vector<std::array<int, 2>> pairs;
  for_elements(cloth, 0, std::numeric_limits<int>::max(), [&](const auto& element) {
    const auto particles = particles_of(element);
    for (std::size_t r = 0; r < particles.size(); ++r)
      for (std::size_t c = 0; c <= r; ++c) pairs.push_back({particles[r], particles[c]});
  });
  return pairs;
}

void stiffness_blocks(const Cloth& cloth, std::span<const Vec3> x, Stiffness stiffness, int begin, int end,
                      Mat3* blocks) {
  for_elements(cloth, begin, end, [&](const auto& element) {
    const auto particles = particles_of(element);
    for (const int p : particles)
      if (p < 0 || std::size_t(p) >= x.size())
        throw std::invalid_argument("stiffness_blocks: an element names particle " + std::to_string(p) +
                                    " of " + std::to_string(x.size()));
    if constexpr (particles.size() == 4)
      stiffness_blocks(x, element, cloth.hinge_law, stiffness, blocks);
    else
      stiffness_blocks(x, element, stiffness, blocks);
    blocks += lower_blocks(int(particles.size()));
  });
}

}  // namespace furrow::physics
