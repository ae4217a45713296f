// SPDX-License-Identifier: MIT
#pragma once
#include <array>

#include "physics/base/arrays.h"

namespace furrow::physics {

/// Two primitives, each of which moves along a line: four vertices, as PairDistance has them.
struct MovingPair {
  bool edges;                ///< edge against edge; else vertex against triangle
  std::array<Vec3, 4> x;     ///< at the start [m]
  std::array<Vec3, 4> move;  ///< of the whole step [m]
};

/// The largest share of the step, in [0, 1], that is known to keep the two at least a tenth of min(their
/// distance at the start, range) [m] apart, to within a tenth of that distance: conservative advancement. 0
/// if they touch at the start, to rounding; 1 if they never come nearer than the range, whatever they do
/// beyond it. Motion that both have in common costs nothing. Cost: one distance where nothing is near, some
/// four otherwise, a thousand at most.
/// \details The distance shrinks no faster than the longest move of the one's vertices less the mean, and
/// the same of the other, so each advance by (distance - least) / (that speed) keeps them apart. Source: Li,
/// Kaufman and Jiang 2021, Codimensional Incremental Potential Contact, section 5. Where that reaches
/// farther, an advance goes as far as a plane across the shortest way keeps all their vertices apart: what
/// slides along a gap of nanometres is not held up by it.
double time_of_impact(const MovingPair& pair, double range);

}  // namespace furrow::physics
