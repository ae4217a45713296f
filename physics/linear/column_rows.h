// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace furrow::physics {

/// Of each column of a sparse symmetric matrix the rows below its diagonal, ascending, without repetition,
/// one column after the other.
struct ColumnRows {
  std::vector<std::size_t> first{0};  ///< where those of each column begin, and the end
  std::vector<int> rows;

  ColumnRows() = default;
  explicit ColumnRows(std::span<const std::vector<int>> lists) {
    for (const std::vector<int>& list : lists) add(list);
  }
  void add(std::span<const int> column) {
    rows.insert(rows.end(), column.begin(), column.end());
    first.push_back(rows.size());
  }
  int columns() const { return int(first.size()) - 1; }
  std::span<const int> of(int column) const {
    const std::size_t begin = first[std::size_t(column)];
    return {rows.data() + begin, first[std::size_t(column) + 1] - begin};
  }
};

}  // namespace furrow::physics
