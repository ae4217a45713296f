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

/// How many there are of each kind.
std::array<int, 5> count_elements(const Cloth& cloth);
/// How many blocks the elements before one have; element in [0, sum of the counts].
int first_block(const std::array<int, 5>& counts, int element);
/// Of each block the particles (i, j) of its row and column. Throws std::invalid_argument as add_stiffness().
std::vector<std::array<int, 2>> block_pairs(const Cloth& cloth);
/// The blocks of the elements [begin, end) at x. Throws std::invalid_argument if one names a particle out of
/// range, or as membrane_constants() does.
void stiffness_blocks(const Cloth& cloth, std::span<const Vec3> x, Stiffness stiffness, int begin, int end,
                      Mat3* blocks);

}  // namespace furrow::physics
