// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

#include "physics/rest/prestress.h"

namespace furrow::physics {

/// One for each piece with free particles whose pins leave a freedom, in the order of their first particles.
/// load: force on each particle [N]; that on pins does not count. Pins are on one line if none is farther
/// from it than 1e-6 of the piece's size. Cost: one pass over the elements. Throws std::invalid_argument if
/// lengths differ or an element names a particle out of range.
std::vector<RigidImbalance> rigid_imbalances(const Cloth& cloth, std::span<const Vec3> load);

/// Takes the load off that would move the piece: mass times the acceleration at each of its particles.
void remove_rigid_load(const Cloth& cloth, const RigidImbalance& imbalance, std::span<Vec3> load);

/// Turns each piece that hangs on a line of pins or on one pin, rigidly about it, until the centre of its
/// free mass hangs lowest; particles at rest keep their pins, elements their state. Pieces without a pin,
/// pieces whose pins hold them, and axes along gravity stay. Returns the largest turn [rad]. gravity [m/s^2].
/// Errors as rigid_imbalances().
double balance_rigidly(Cloth& cloth, const Vec3& gravity);

}  // namespace furrow::physics
