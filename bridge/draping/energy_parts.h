// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "bridge/draping/drape.h"
#include "physics/cloth/cloth.h"

namespace furrow::bridge {

/// That of elements and weight; contact is left 0, as only a search for rest knows it. places: where weight
/// counts as 0, one a particle [m]; what is held has none. Cost: one pass. Throws std::invalid_argument if
/// lengths differ, and as physics::potential_energy().
EnergyParts energy_parts(const physics::Cloth& cloth, const physics::Vec3& gravity,
                         const std::vector<physics::Vec3>& places);

}  // namespace furrow::bridge
