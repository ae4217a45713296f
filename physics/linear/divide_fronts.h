// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <vector>

#include "physics/linear/front_tree.h"

namespace furrow::physics {

/// How threads share a tree of fronts: branches, each done by one thread, and the trunk that they grow from,
/// done by all together.
struct FrontDivision {
  std::vector<std::array<int, 2>> branches;  ///< ranges of fronts, the most work first
  std::vector<int> trunk;                    ///< children before parents
};

/// The division with the least expected time. One thread: no trunk. Cost: of the order of the fronts.
FrontDivision divide_fronts(const std::vector<FrontTree::Front>& fronts, int threads);

}  // namespace furrow::physics
