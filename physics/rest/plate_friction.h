// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <vector>

#include "physics/cloth/cloth.h"
#include "physics/rest/hinge_friction.h"

namespace furrow::physics {

/// Internal friction of bending of plates: beside each plate of a cloth stands a second one, at the end of
/// cloth.energies, whose curvature at rest k_p creeps along:
///   moments M = k_f D (k - k_p),  |M| = sqrt(M11^2 + M22^2 + 2 M12^2) <= limit,
/// Prandtl's element a triangle, so it belongs to the cloth and not to its mesh. Energy, forces and solvers
/// know it as a plate with k_p fixed; only update_friction() moves k_p. A strip bent to and fro has the loop
/// of a hinge (hinge_friction.h), its moment a metre of width.
struct PlateFriction {
  std::vector<std::size_t> energies;  ///< cloth.energies[i] are the second plates
  double limit = 0;                   ///< [N]
};

/// Adds them, at rest where the others are. Without plates, or without calling it, nothing changes.
/// O(triangles). Throws std::invalid_argument, nothing changed, if an option is out of its range.
PlateFriction add_plate_friction(Cloth& cloth, const HingeFrictionOptions& options);

/// The return mapping at the cloth's positions, as for hinges: where |M| is above the limit, k_p follows
/// until it is the limit. The second plates are replaced, so a copy of the cloth keeps its own. Returns the
/// largest move of a k_p times sqrt(2 area), an angle over an edge [rad]. O(triangles). Throws
/// std::invalid_argument if the friction is not this cloth's.
double update_friction(Cloth& cloth, const PlateFriction& friction);

}  // namespace furrow::physics
