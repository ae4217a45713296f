// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

#include "physics/base/arrays.h"

namespace furrow::physics {

struct PairMesh;  // pair_mesh.h

struct ContourOptions {
  double longest_move = 0.1;  ///< of a vertex in a round, over the mean edge [-]; > 0
  double farthest = 3;        ///< from where it was, over the mean edge [-]; > 0: there a vertex stays
  int most_rounds = 200;      ///< of each of two tries; >= 0
  int patience = 30;  ///< rounds after which a contour that is not a hundredth shorter is given up; >= 1
};

/// A line along which cloth goes on crossing itself.
struct CrossingLine {
  Vec3 middle = Vec3::Zero();  ///< [m]
  double length = 0;           ///< [m]
  int crossings = 0;           ///< edges through faces
};

struct ContourReport {
  int at_start = 0;                 ///< edges through faces
  int left = 0;                     ///< that still pass through some; <= at_start
  int rounds = 0;                   ///< of moves
  double farthest = 0;              ///< way of the vertex that was moved most [m]
  std::vector<CrossingLine> lines;  ///< what is left, longest first
};

/// Of searches one after the other: the first start at which anything crossed, what the last one left, rounds
/// of all, the farthest way of any.
void add_later(const ContourReport& now, ContourReport& all);

/// Takes a cloth apart that crosses itself, without knowing which side is which: the lines in which it does
/// (tangle_contours.h) are made shorter, each by moving both sides as a whole. Where that leads nowhere, the
/// smaller part that a line cuts off goes back. x: one a particle [m]; ends as the positions with the fewest
/// crossings, never more than at the start. What is held stays. A line that does not become shorter is given
/// up; where something is left, all of it is tried again with moves three times as long. Same input, same
/// bits. Cost: some 1 us a triangle and a round. Throws std::invalid_argument if an option is out of its
/// range or lengths differ. \details Source: Volino, Magnenat-Thalmann 2006, for opposite moves of both
/// sides; decisions/0024.
ContourReport untangle_contours(std::span<Vec3> x, const PairMesh& mesh, const ContourOptions& options = {});

}  // namespace furrow::physics
