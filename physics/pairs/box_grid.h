// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/base/arrays.h"

namespace furrow::physics {

/// An axis-parallel box; single precision, so that eight of them fill four lines of the cache.
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
  /// cell > 0 [m]: the mean side of a box, or more. Cost: O(cells met).
  BoxGrid(std::span<const FloatBox> boxes, double cell);

  /// visit(i) for each box i that meets this one, once, in no order that means anything, but always the same.
  /// Boxes are less than a thousand cells long.
  template <class Visit>
  void each_meeting(const FloatBox& box, Visit&& visit) const;

 private:
  using Cell = std::array<std::int32_t, 3>;
  struct Entry {
    FloatBox box;
    std::int32_t number;
    std::uint32_t name;  // of its cell
  };
  Cell cell_of(const std::array<float, 3>& p) const {
    return {std::int32_t(std::floor(p[0] * per_cell_)), std::int32_t(std::floor(p[1] * per_cell_)),
            std::int32_t(std::floor(p[2] * per_cell_))};
  }
  /// The same for two cells only where they are a thousand apart.
  static std::uint32_t name(const Cell& c) {
    return (std::uint32_t(c[0]) & 2047u) | (std::uint32_t(c[1]) & 2047u) << 11 |
           (std::uint32_t(c[2]) & 1023u) << 22;
  }
  static std::uint32_t hash(const Cell& c) {
    std::uint32_t h =
        std::uint32_t(c[0]) * 73856093u ^ std::uint32_t(c[1]) * 19349663u ^ std::uint32_t(c[2]) * 83492791u;
    h ^= h >> 15;
    h *= 2246822519u;
    return h ^ h >> 13;
  }
  template <class Work>
  void each_cell(const FloatBox& box, Work&& work) const {
    const Cell from = cell_of(box.low), to = cell_of(box.high);
    for (std::int32_t i = from[0]; i <= to[0]; ++i)
      for (std::int32_t j = from[1]; j <= to[1]; ++j)
        for (std::int32_t k = from[2]; k <= to[2]; ++k) work(Cell{i, j, k});
  }

  float per_cell_;
  std::uint32_t mask_ = 0;
  std::vector<std::uint32_t> begin_;  // of each bucket, and the end
  std::vector<Entry> entries_;
};

/// Two boxes meet in the cells of their intersection: the first of these counts.
template <class Visit>
void BoxGrid::each_meeting(const FloatBox& box, Visit&& visit) const {
  each_cell(box, [&](const Cell& cell) {
    const std::uint32_t bucket = hash(cell) & mask_, own = name(cell);
    for (std::uint32_t e = begin_[bucket]; e < begin_[bucket + 1]; ++e) {
      const Entry& other = entries_[e];
      const FloatBox& b = other.box;
      const bool meets = (b.low[0] <= box.high[0]) & (box.low[0] <= b.high[0]) & (b.low[1] <= box.high[1]) &
                         (box.low[1] <= b.high[1]) & (b.low[2] <= box.high[2]) & (box.low[2] <= b.high[2]) &
                         (other.name == own);
      if (!meets) continue;
      const std::array<float, 3> corner{std::max(b.low[0], box.low[0]), std::max(b.low[1], box.low[1]),
                                        std::max(b.low[2], box.low[2])};
      if (cell_of(corner) == cell) visit(int(other.number));
    }
  });
}

}  // namespace furrow::physics
