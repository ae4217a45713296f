// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

#include "physics/pairs/pair_mesh.h"

namespace furrow::physics {

/// Garments that are worn over each other, in one cloth.
struct ClothLayers {
  std::vector<int> of_vertex;  ///< 0: the innermost
  std::vector<char> turned;    ///< by layer: its faces look inwards
};

struct UntangleOptions {
  double longest_move = 0.1;  ///< of a vertex in a round, over the mean edge [-]; > 0
  double farthest = 3;        ///< from where it was, over the mean edge [-]; > 0: there a vertex stays
  int most_rounds = 200;      ///< >= 0
  int patience = 30;          ///< rounds without fewer crossings, after which it gives up; >= 1
};

struct UntangleReport {
  int at_start = 0;  ///< edges of one layer that passed through faces of another
  int left = 0;      ///< that still do
  int near = 0;  ///< pairs of two layers that are nearer than half of what keeps them apart; if none is left
  int rounds = 0;      ///< of moves
  double farthest = 0; /**< way of the vertex that was moved most [m] */
};

/// Takes layers apart that cross each other, by their order: where an edge of one passes through a face of
/// another, or comes nearer than half their thickness, the outer one goes outwards along the inner one's
/// normal, until nothing does. Vertices that
/// are held stay. x: one a particle [m]; ends as the positions with the fewest crossings, never more than at
/// the start. It moves what crosses and what is around, and looks at crossings between layers alone: a layer
/// may come to cross itself. Cost: some 1 us a triangle and a round. Throws std::invalid_argument if lengths
/// differ.
/// \details A move is smoothed over neighbours five times, and is at most a third of the shortest edge at a
/// vertex. Prototype and choice: decisions/0024.
UntangleReport untangle_layers(std::span<Vec3> x, const PairMesh& mesh, const ClothLayers& layers,
                               const UntangleOptions& options = {});

}  // namespace furrow::physics
