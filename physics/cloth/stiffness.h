// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <functional>

#include "physics/base/particles.h"

namespace furrow::physics {

/// Which part of the second derivative of an energy counts: the Hessian itself, which is indefinite where
/// springs are compressed or hinges bent; a semidefinite part of it (springs without the transverse part of
/// compressed ones; see each element); or what lies between.
struct Stiffness {
  double clamped;  ///< share of the way from the Hessian to the semidefinite part [-]; in [0, 1]
  static const Stiffness exact, positive_part;
  bool operator==(const Stiffness&) const = default;
};
inline constexpr Stiffness Stiffness::exact{0}, Stiffness::positive_part{1};

/// Takes what one element adds to the block of the stiffness matrix K [N/m] in the rows of particle i and the
/// columns of particle j. K is the second derivative of the energy, so forces change by -K u.
using BlockSink = std::function<void(int i, int j, const Mat3& block)>;

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
