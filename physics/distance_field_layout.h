// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>

/// How DistanceField packs a child or a top cell into 32 bits: a node is its index; a leaf has the highest bit set,
/// its index in the lowest 27 bits and, in the top table only, its level in the four between.
namespace furrow::physics::distance_field_layout {

constexpr std::uint32_t leaf_bit = 1u << 31;
constexpr int level_shift = 27;
constexpr std::uint32_t level_mask = 15;
constexpr std::uint32_t index_mask = (1u << level_shift) - 1;

}  // namespace furrow::physics::distance_field_layout
