// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>

/// How DistanceField finds the leaf of a point in three steps without a loop: a dense top table names a
/// brick, a dense table of 2^k cells along each edge, which names the leaf. 32 bits each:
///   top cell     k in the four highest bits, the place of the brick's first cell in the others;
///   brick cell   leaf: leaf_bit, its level in four bits, its index; node (below brick_depth levels only):
///   its index; node child   leaf: leaf_bit and its index; node: its index.
namespace furrow::physics::distance_field_layout {

constexpr std::uint32_t leaf_bit = 1u << 31;
constexpr int level_shift = 27;
constexpr std::uint32_t level_mask = 15;
constexpr std::uint32_t index_mask = (1u << level_shift) - 1;

constexpr int brick_shift = 28;
constexpr std::uint32_t brick_mask = (1u << brick_shift) - 1;
constexpr int brick_depth = 3;  ///< largest k

}  // namespace furrow::physics::distance_field_layout
