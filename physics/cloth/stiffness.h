// SPDX-License-Identifier: MIT
#pragma once
#include <array>

#include "physics/cloth/cloth.h"

namespace furrow::physics {

/// An element's share of K, which is symmetric, is kept as blocks on and below the diagonal, of its particles
/// in order: (0, 0), (1, 0), (1, 1), (2, 0) ...
constexpr int lower_blocks(int particles) { return particles * (particles + 1) / 2; }
constexpr int lower_block(int row, int column) { return lower_blocks(row) + column; }

/// Hands out all blocks, (0, 0), (0, 1) ..., of an element that has these on and below the diagonal.
template <std::size_t n>
void hand_out(const std::array<int, n>& particles, const Mat3* lower, const BlockSink& sink) {
  for (int r = 0; r < int(n); ++r) {
    for (int c = 0; c < int(n); ++c) {
      if (r >= c)
        sink(particles[r], particles[c], lower[lower_block(r, c)]);
      else
        sink(particles[r], particles[c], lower[lower_block(c, r)].transpose());
    }
  }
}

}  // namespace furrow::physics
