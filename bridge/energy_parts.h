// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "physics/cloth/cloth.h"

namespace furrow::bridge {

/// The energy of a cloth by what stores it [J].
struct EnergyParts {
  double stretch = 0;  ///< structural springs, tension and triangles
  double bending = 0;  ///< hinges, plates and other energies; without any, the springs across edges
  double ties = 0;     ///< struts: bands, joined seams
  double weight = 0;   ///< against where it lay before
  double contact = 0;  ///< with the body, its friction, and of the cloth with itself
  double total() const { return stretch + bending + ties + weight + contact; }
};

/// That of elements and weight; contact is left 0, as only a search for rest knows it. places: where weight
/// counts as 0, one a particle [m]; what is held has none. Cost: one pass. Throws std::invalid_argument if
/// lengths differ, and as physics::potential_energy().
EnergyParts energy_parts(const physics::Cloth& cloth, const physics::Vec3& gravity,
                         const std::vector<physics::Vec3>& places);

}  // namespace furrow::bridge
