// SPDX-License-Identifier: MIT
#include "physics/cloth/element_blocks.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "physics/base/require.h"
#include "physics/cloth/cloth.h"
#include "physics/cloth/elements.h"
#include "physics/cloth/kinds.h"

namespace furrow::physics {
namespace {

/// Calls visit(element, law...) on each element of [begin, end); own(energy, kind) on each energy there.
template <class Visit, class Own>
void for_elements(const Cloth& cloth, int begin, int end, const Visit& visit, const Own& own) {
  for_each_kind(cloth, [&](const auto& kind, auto... law) {
    const int n = int(kind.size());
    for (int i = std::max(begin, 0); i < std::min(end, n); ++i) visit(kind[std::size_t(i)], law...);
    begin -= n, end -= n;
  });
  const int n = int(cloth.energies.size());
  for (int i = std::max(begin, 0); i < std::min(end, n); ++i) own(*cloth.energies[std::size_t(i)], i);
}

/// Calls take(i, j, block) for the blocks of an energy with i >= j.
template <class Take>
void lower_blocks_of(const Energy& own, std::span<const Vec3> x, Stiffness stiffness, const Take& take) {
  own.add_stiffness(x, stiffness, [&](int i, int j, const Mat3& block) {
    if (i < 0 || j < 0 || std::size_t(std::max(i, j)) >= x.size())
      refuse("stiffness_blocks", "an energy names particles ", i, " and ", j, " of ", x.size());
    if (i >= j) take(i, j, block);
  });
}

}  // namespace

int ElementCounts::total() const { return std::accumulate(elements.begin(), elements.end(), 0); }

ElementCounts count_elements(const Cloth& cloth, Stiffness stiffness) {
  check_elements(cloth, cloth.particles.size());
  ElementCounts counts;
  for_each_kind(cloth, [&](const auto& kind, auto...) {
    counts.elements.push_back(int(kind.size()));
    counts.blocks.push_back(lower_blocks(int(decltype(vertices(kind[0])){}.size())));
  });
  for (const auto& own : cloth.energies) {
    counts.elements.push_back(1);
    int& blocks = counts.blocks.emplace_back(0);
    lower_blocks_of(*own, cloth.particles.x, stiffness, [&](int, int, const Mat3&) { ++blocks; });
  }
  return counts;
}

bool fits(const ElementCounts& counts, const Cloth& cloth) {
  std::size_t kind = 0;
  bool equal = true;
  for_each_kind(cloth, [&](const auto& elements, auto...) {
    equal = equal && counts.elements[kind++] == int(elements.size());
  });
  return equal && counts.elements.size() == kind + cloth.energies.size();
}

int first_block(const ElementCounts& counts, int element) {
  int blocks = 0;
  for (std::size_t kind = 0; kind < counts.elements.size(); ++kind) {
    const int before = std::clamp(element, 0, counts.elements[kind]);
    blocks += before * counts.blocks[kind];
    element -= before;
  }
  return blocks;
}

std::vector<std::array<int, 2>> block_pairs(const Cloth& cloth, Stiffness stiffness) {
  check_elements(cloth, cloth.particles.size());
  std::vector<std::array<int, 2>> pairs;
  for_elements(
      cloth, 0, std::numeric_limits<int>::max(),
      [&](const auto& element, auto...) {
        const auto particles = vertices(element);
        for (std::size_t r = 0; r < particles.size(); ++r)
          for (std::size_t c = 0; c <= r; ++c) pairs.push_back({particles[r], particles[c]});
      },
      [&](const Energy& own, int) {
        lower_blocks_of(own, cloth.particles.x, stiffness, [&](int i, int j, const Mat3&) {
          pairs.push_back({i, j});
        });
      });
  return pairs;
}

void stiffness_blocks(const Cloth& cloth, const ElementCounts& counts, std::span<const Vec3> x,
                      Stiffness stiffness, int begin, int end, Mat3* blocks) {
  const std::size_t kinds = counts.elements.size() - cloth.energies.size();
  for_elements(
      cloth, begin, end,
      [&](const auto& element, auto... law) {
        const auto particles = vertices(element);
        for (const int p : particles)
          if (p < 0 || std::size_t(p) >= x.size())
            refuse("stiffness_blocks", "an element names particle ", p, " of ", x.size());
        stiffness_blocks(x, element, law..., stiffness, blocks);
        blocks += lower_blocks(int(particles.size()));
      },
      [&](const Energy& own, int i) {
        const int most = counts.blocks[kinds + std::size_t(i)];
        int n = 0;
        lower_blocks_of(own, x, stiffness, [&](int, int, const Mat3& block) {
          if (n++ < most) *blocks++ = block;
        });
        if (n != most)
          refuse("stiffness_blocks", "an energy hands out ", n, " blocks of the lower triangle, ", most,
                 " before");
      });
}

}  // namespace furrow::physics
