// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "physics/plate/plate_net.h"

namespace furrow::physics {

/// A hinge's share in a sum over hinges' angles [-].
struct HingeShare {
  int hinge;
  double factor;
};

/// How much of a hinge's angle lies in the triangle left of it, psi = sum of factor times angle; what is left
/// of the angle lies in the other one. Exact (to 1e-5) for every quadratic surface, by the hinges around;
/// where they cannot tell, the areas do. A triangle that is held takes nothing.
/// Cost: unfolding of six triangles, more where the hinges around are of few directions. Source: the
/// reconstruction of the slopes of Morley's triangle is our own (decisions/0022-plate.md).
std::vector<HingeShare> left_share(const PlateNet& net, int hinge);

}  // namespace furrow::physics
