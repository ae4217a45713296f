// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include "physics/cloth/cloth.h"

namespace furrow::physics {

/// Several cloths as one, their particles one after the other: nothing joins them. What each is made of keeps
/// its order, so sums do, too; energies of a caller's own go on seeing their own particles alone. Throws
/// std::invalid_argument where hinges follow several laws. O(size).
Cloth join_cloths(std::span<const Cloth> cloths);

}  // namespace furrow::physics
