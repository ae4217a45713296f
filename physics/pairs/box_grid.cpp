// SPDX-License-Identifier: MIT
#include "physics/pairs/box_grid.h"

#include <algorithm>
#include <limits>

#include "physics/base/require.h"

namespace furrow::physics {

FloatBox box_around(std::span<const Vec3> points, const Vec3& origin, double reach) {
  constexpr double rounding = 2 * double(std::numeric_limits<float>::epsilon());
  FloatBox box;
  for (int axis = 0; axis < 3; ++axis) {
    double low = points[0][axis], high = low;
    for (const Vec3& p : points.subspan(1)) {
      low = std::min(low, p[axis]);
      high = std::max(high, p[axis]);
    }
    low -= origin[axis] + reach;
    high += reach - origin[axis];
    box.low[std::size_t(axis)] = float(low - rounding * std::abs(low));
    box.high[std::size_t(axis)] = float(high + rounding * std::abs(high));
  }
  return box;
}

BoxGrid::BoxGrid(std::span<const FloatBox> boxes, double cell) : per_cell_(float(1 / cell)) {
  require("BoxGrid", "cell", cell, cell > 0, "> 0");
  std::vector<Cells> cells;
  cells.reserve(boxes.size());
  std::size_t met = 0;
  for (const FloatBox& b : boxes) {
    cells.push_back(cells_of(b));
    const auto& [from, to] = cells.back();
    met += std::size_t(to[0] - from[0] + 1) * std::size_t(to[1] - from[1] + 1) *
           std::size_t(to[2] - from[2] + 1);
  }
  std::uint32_t buckets = 16;
  while (buckets < met && buckets < (1u << 30)) buckets *= 2;
  mask_ = buckets - 1;
  begin_.assign(std::size_t(buckets) + 1, 0);
  const auto bucket_of = [this](const Cell& c) { return hash(c) & mask_; };
  for (const Cells& box : cells) each_cell(box, [&](const Cell& c) { ++begin_[bucket_of(c) + 1]; });
  for (std::uint32_t i = 0; i < buckets; ++i) begin_[i + 1] += begin_[i];
  entries_.resize(met);
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    each_cell(cells[i], [&](const Cell& c) {
      entries_[next[bucket_of(c)]++] = {lanes(boxes[i].low, std::uint32_t(i)),
                                        lanes(boxes[i].high, name(c) | first(c, cells[i].from))};
    });
}

}  // namespace furrow::physics
