// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/base/arrays.h"
#include "physics/base/float4.h"

namespace furrow::physics {

/// An axis-parallel box; single precision, so that two of them fill a line of the cache.
struct FloatBox {
  std::array<float, 3> low, high;  ///< [m]
};

/// Around points (relative to an origin, so that little is lost), each by `reach` farther [m]; rounding makes
/// it larger, never smaller.
FloatBox box_around(std::span<const Vec3> points, const Vec3& origin, double reach);

/// Boxes in the cells of a grid that they meet, sorted by counting: which of them meet another box is found
/// by looking into its cells. The grid has no bounds (cells are hashed), cells have one size.
class BoxGrid {
 public:
  /// A grid of no boxes.
  BoxGrid() = default;
  /// cell > 0 [m]: the mean side of a box, or more. Cost: O(cells met).
  BoxGrid(std::span<const FloatBox> boxes, double cell);

  /// visit(i) for each box i that meets this one, and i > after, once, in no order that means anything, but
  /// always the same. Boxes are less than five hundred cells long.
  template <class Visit>
  void each_meeting(const FloatBox& box, int after, Visit&& visit) const;
  template <class Visit>
  void each_meeting(const FloatBox& box, Visit&& visit) const {
    each_meeting(box, -1, visit);
  }

 private:
  using Cell = std::array<std::int32_t, 3>;
  struct Cells {
    Cell from, to;
  };
  /// A box in two lanes, with its number and, beside its upper corner, the name of its cell and for each axis
  /// whether that is the box's first.
  struct Entry {
    Float4 low, high;
    std::int32_t number() const { return std::bit_cast<std::int32_t>(low[3]); }
    std::uint32_t name() const { return std::bit_cast<std::uint32_t>(high[3]); }
    bool meets(Float4 other_low, Float4 other_high) const {
      typedef std::int64_t Two __attribute__((vector_size(16)));
      const Two both = reinterpret_cast<Two>((low <= other_high) & (other_low <= high));
      return (both[0] == -1) & (std::int32_t(both[1]) == -1);
    }
  };
  static Float4 lanes(const std::array<float, 3>& p, std::uint32_t fourth) {
    return Float4{p[0], p[1], p[2], std::bit_cast<float>(fourth)};
  }
  /// All that counts is that a larger place never has a smaller cell; rounding to 0 is quicker than down, and
  /// the same where cells are positive.
  std::int32_t cell_of(float p) const { return std::int32_t(p * per_cell_ + 32768.0f); }
  Cells cells_of(const FloatBox& box) const {
    return {{cell_of(box.low[0]), cell_of(box.low[1]), cell_of(box.low[2])},
            {cell_of(box.high[0]), cell_of(box.high[1]), cell_of(box.high[2])}};
  }
  /// The same for two cells only where they are half a thousand apart.
  static std::uint32_t name(const Cell& c) {
    return (std::uint32_t(c[0]) & 1023u) | (std::uint32_t(c[1]) & 1023u) << 10 |
           (std::uint32_t(c[2]) & 511u) << 20;
  }
  static std::uint32_t first(const Cell& c, const Cell& from) {
    return std::uint32_t(c[0] == from[0]) << 29 | std::uint32_t(c[1] == from[1]) << 30 |
           std::uint32_t(c[2] == from[2]) << 31;
  }
  static constexpr std::uint32_t all_first = 7u << 29, whole_name = (1u << 29) - 1;
  static std::uint32_t hash(const Cell& c) {
    std::uint32_t h =
        std::uint32_t(c[0]) * 73856093u ^ std::uint32_t(c[1]) * 19349663u ^ std::uint32_t(c[2]) * 83492791u;
    h ^= h >> 15;
    h *= 2246822519u;
    return h ^ h >> 13;
  }
  template <class Work>
  static void each_cell(const Cells& cells, Work&& work) {
    for (std::int32_t i = cells.from[0]; i <= cells.to[0]; ++i)
      for (std::int32_t j = cells.from[1]; j <= cells.to[1]; ++j)
        for (std::int32_t k = cells.from[2]; k <= cells.to[2]; ++k) work(Cell{i, j, k});
  }

  float per_cell_ = 1;
  std::uint32_t mask_ = 0;
  std::vector<std::uint32_t> begin_ = {0, 0};  // of each bucket, and the end
  std::vector<Entry> entries_;                 // of a bucket by number
};

/// Two boxes meet in the cells of their intersection: the first of these counts, which on each axis is the
/// first of the one or the other.
template <class Visit>
void BoxGrid::each_meeting(const FloatBox& box, int after, Visit&& visit) const {
  const Cells cells = cells_of(box);
  const Float4 low = lanes(box.low, 0), high = lanes(box.high, 0);
  each_cell(cells, [&](const Cell& cell) {
    const std::uint32_t bucket = hash(cell) & mask_, own = name(cell), own_first = first(cell, cells.from);
    for (std::uint32_t e = begin_[bucket + 1]; e > begin_[bucket]; --e) {
      const Entry& other = entries_[e - 1];
      if (other.number() <= after) break;
      const bool meets = other.meets(low, high) & ((other.name() & whole_name) == own) &
                         (((other.name() | own_first) & all_first) == all_first);
      if (meets) visit(int(other.number()));
    }
  });
}

}  // namespace furrow::physics
