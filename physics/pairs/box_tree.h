// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "physics/pairs/pair_bounds.h"

namespace furrow::physics {

typedef std::int32_t Int4 __attribute__((vector_size(16)));

/// A bit for each lane that is not 0 (all bits of it are 1 then).
inline unsigned bits_of(Int4 lanes) {
#ifdef __SSE2__
  typedef float Packed __attribute__((vector_size(16)));
  return unsigned(__builtin_ia32_movmskps(reinterpret_cast<Packed>(lanes)));
#else
  return unsigned(lanes[0] & 1) | unsigned(lanes[1] & 2) | unsigned(lanes[2] & 4) | unsigned(lanes[3] & 8);
#endif
}

/// An axis-parallel box; the fourth lanes mean nothing.
struct LaneBox {
  Float4 low, high;  ///< [m]
};

/// Where vertices are and where they go, as float_point() has them. plan: empty, nothing moves.
struct FloatSweep {
  std::vector<Float4> at, plan;

  void assign(std::span<const Vec3> x, std::span<const Vec3> way, const Vec3& origin);
  /// Around these vertices, everywhere on their way, by `reach` farther [m]; rounding makes it larger.
  LaneBox box(std::span<const int> vertices, float reach) const;
};

/// A box of nothing, which meets nothing.
inline LaneBox empty_box() {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  return {splat(infinite), splat(-infinite)};
}

/// Four boxes, one a lane. An empty lane meets nothing.
struct FourBoxes {
  std::array<Float4, 3> low, high;

  static FourBoxes of(const std::array<LaneBox, 4>& boxes);
  /// Each lane becomes the box around itself and this one's.
  void add(const FourBoxes& other) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = min(low[k], other.low[k]);
      high[k] = max(high[k], other.high[k]);
    }
  }
  Int4 meet(const LaneBox& box) const {
    return (low[0] <= splat(box.high[0])) & (splat(box.low[0]) <= high[0]) & (low[1] <= splat(box.high[1])) &
           (splat(box.low[1]) <= high[1]) & (low[2] <= splat(box.high[2])) & (splat(box.low[2]) <= high[2]);
  }
  /// Around all four.
  LaneBox all() const;
  LaneBox lane(std::size_t i) const {
    return {Float4{low[0][i], low[1][i], low[2][i], 0}, Float4{high[0][i], high[1][i], high[2][i], 0}};
  }
};

/// How many rows of four hold so many.
inline std::size_t rows_of(std::size_t n) { return (n + 3) / 4; }

/// Boxes in a tree of fours, as they come: neighbours should stand next to each other.
class BoxTree {
 public:
  /// Cost: O(boxes).
  void assign(std::vector<FourBoxes> boxes);
  /// visit(i) for each box i >= from that meets this one, in rising order.
  template <class Visit>
  void each_meeting(const LaneBox& box, int from, Visit&& visit) const {
    if (!levels_.empty()) descend(levels_.size() - 1, 0, box, from, visit);
  }
  LaneBox box(int i) const { return levels_[0][std::size_t(i) / 4].lane(std::size_t(i) % 4); }

 private:
  template <class Visit>
  void descend(std::size_t level, int group, const LaneBox& box, int from, Visit& visit) const {
    for (unsigned met = bits_of(levels_[level][std::size_t(group)].meet(box)); met != 0; met &= met - 1) {
      const int child = 4 * group + std::countr_zero(met);
      if (level == 0 && child >= from) visit(child);
      if (level > 0 && std::int64_t(child + 1) << 2 * level > from)
        descend(level - 1, child, box, from, visit);
    }
  }
  std::vector<std::vector<FourBoxes>> levels_;  // of the boxes, of fours of them, …; the last has one
};

}  // namespace furrow::physics
