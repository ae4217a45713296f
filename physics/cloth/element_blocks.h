// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <span>
#include <vector>

#include "physics/cloth/cloth.h"
#include "physics/cloth/stiffness.h"

namespace furrow::physics {

/// What add_stiffness() hands out, by parts that threads can share: all elements of a cloth by one number, in
/// its order, each with its blocks on and below the diagonal (stiffness.h) behind those of the one before it.
/// One of Cloth::energies counts as one element; it has the blocks (i, j) with i >= j that it hands out.

/// How many elements there are of each kind, and blocks in each of them; an energy is a kind of its own.
struct ElementCounts {
  std::vector<int> elements, blocks;
  int total() const;
};
/// Throws std::invalid_argument as add_stiffness(). Cost: a pass of the energies' stiffness.
ElementCounts count_elements(const Cloth& cloth, Stiffness kind = Stiffness::exact);
/// Whether a cloth has as many elements of each kind, and as many energies.
bool fits(const ElementCounts& counts, const Cloth& cloth);
/// How many blocks the elements before one have; element in [0, total()].
int first_block(const ElementCounts& counts, int element);
/// Of each block the particles (i, j) of its row and column. Throws std::invalid_argument as add_stiffness().
std::vector<std::array<int, 2>> block_pairs(const Cloth& cloth, Stiffness kind = Stiffness::exact);
/// The blocks of the elements [begin, end) at x. Throws std::invalid_argument if one names a particle out of
/// range, as membrane_constants() does, or if an energy hands out more or fewer blocks than were counted.
void stiffness_blocks(const Cloth& cloth, const ElementCounts& counts, std::span<const Vec3> x,
                      Stiffness stiffness, int begin, int end, Mat3* blocks);

}  // namespace furrow::physics
