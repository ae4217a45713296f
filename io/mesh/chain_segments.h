// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstddef>
#include <vector>

namespace furrow::io {

struct Chain {
  std::vector<std::size_t> vertices;  ///< the first is not repeated at the end of a closed one
  bool closed = false;
};

/// Joins segments (pairs of vertices) that share a vertex into chains. A chain ends where one, or more than
/// two, segments meet; closed loops are found. Segments of one vertex and repeated segments are dropped. Open
/// chains come first, in the order of their first segments, then loops. Cost: O(n log n).
std::vector<Chain> chain_segments(const std::vector<std::array<std::size_t, 2>>& segments);

}  // namespace furrow::io
