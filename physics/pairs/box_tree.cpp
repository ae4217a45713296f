// SPDX-License-Identifier: MIT
#include "physics/pairs/box_tree.h"

#include <limits>

namespace furrow::physics {
namespace {

/// Four rows of three coordinates become three lanes.
std::array<Float4, 3> transposed(const Float4& p, const Float4& q, const Float4& r, const Float4& s) {
  const Float4 pq = __builtin_shufflevector(p, q, 0, 4, 1, 5), rs = __builtin_shufflevector(r, s, 0, 4, 1, 5);
  const Float4 pq2 = __builtin_shufflevector(p, q, 2, 6, 3, 7),
               rs2 = __builtin_shufflevector(r, s, 2, 6, 3, 7);
  return {__builtin_shufflevector(pq, rs, 0, 1, 4, 5), __builtin_shufflevector(pq, rs, 2, 3, 6, 7),
          __builtin_shufflevector(pq2, rs2, 0, 1, 4, 5)};
}

}  // namespace

void FloatSweep::assign(std::span<const Vec3> x, std::span<const Vec3> way, const Vec3& origin) {
  at.resize(x.size());
  plan.resize(way.size());
  for (std::size_t i = 0; i < x.size(); ++i) at[i] = float_point(x[i], origin);
  for (std::size_t i = 0; i < way.size(); ++i) plan[i] = float_point(way[i], Vec3::Zero());
}

LaneBox FloatSweep::box(std::span<const int> vertices, float reach) const {
  LaneBox box = empty_box();
  for (const int number : vertices) {
    const auto v = std::size_t(number);
    box = {min(box.low, at[v]), max(box.high, at[v])};
    if (plan.empty()) continue;
    const Float4 end = at[v] + plan[v];
    box = {min(box.low, end), max(box.high, end)};
  }
  const float far = reach + 4 * std::numeric_limits<float>::epsilon() * (reach + box.high[3]);
  return {box.low - splat(far), box.high + splat(far)};
}

FourBoxes FourBoxes::of(const std::array<LaneBox, 4>& b) {
  return {transposed(b[0].low, b[1].low, b[2].low, b[3].low),
          transposed(b[0].high, b[1].high, b[2].high, b[3].high)};
}

LaneBox FourBoxes::all() const {
  LaneBox box = empty_box();
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] = least(low[k]);
    box.high[k] = -least(-high[k]);
  }
  return box;
}

void BoxTree::assign(std::vector<FourBoxes> boxes) {
  levels_.clear();
  if (boxes.empty()) return;
  levels_.push_back(std::move(boxes));
  while (levels_.back().size() > 1) {
    const std::vector<FourBoxes>& below = levels_.back();
    std::vector<FourBoxes> level;
    level.reserve(rows_of(below.size()));
    for (std::size_t i = 0; i < below.size(); i += 4) {
      std::array<LaneBox, 4> four;
      for (std::size_t j = 0; j < 4; ++j) four[j] = i + j < below.size() ? below[i + j].all() : empty_box();
      level.push_back(FourBoxes::of(four));
    }
    levels_.push_back(std::move(level));
  }
}

}  // namespace furrow::physics
