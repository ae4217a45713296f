// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string_view>

#include "physics/cloth/cloth.h"

namespace furrow::physics {

/// What every operation on a cloth asks before it changes anything: the particles' arrays are of one length,
/// positions and velocities are finite, masses are >= 0 and of free particles > 0, inverse masses are 0 or
/// those of the masses, all elements and triangles name particles that are there, and rest states and
/// stiffnesses are in their ranges. Throws std::invalid_argument with the operation's name, naming the first
/// that is not. O(particles + elements).
void check_cloth(const Cloth& cloth, std::string_view operation);

/// Throws std::invalid_argument unless there is one load [N] a particle, or none at all, and all are finite.
void check_loads(const Cloth& cloth, std::span<const Vec3> loads, std::string_view operation);

}  // namespace furrow::physics
