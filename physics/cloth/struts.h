// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include "physics/cloth/cloth.h"

namespace furrow::physics {

struct StrutOptions {
  double stiffness = 3;           ///< [N/m]; >= 0
  int nearest = 2, farthest = 4;  ///< rings apart, counted in edges; 2 <= nearest <= farthest
  /// Of the fold [m]; >= 0. Where > 0 struts are a quarter to half of it long, so that they mean the same on
  /// a fine mesh as on a coarse one; on one whose rings reach farther, the rings count.
  double width = 0;
};

/// Gives a fold depth, as a truss has: springs at rest as they lie, between particles of the patch that are
/// so many rings apart. With a width: that are so far apart, and joined by edges within that distance;
/// particles closer than width / 8 to one that has struts get none, so that there are as many of them on a
/// fine mesh as on one of such edges. They become bending springs, sorted in, but where there is one already
/// or both ends are pinned. Edges are those of cloth.triangles. Forces change only when the cloth moves, so
/// that a balance stays; prestress() again shares it out anew. Returns how many. Cost: a search of `farthest`
/// rings, or of a disc of the width, for each particle of the patch that gets struts, a sort.
/// Throws std::invalid_argument, nothing changed, if an option or an index is out of its range.
int add_struts(Cloth& cloth, std::span<const int> patch, const StrutOptions& options = {});

}  // namespace furrow::physics
