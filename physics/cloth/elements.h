// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include "physics/cloth/cloth.h"
#include "physics/cloth/stiffness.h"

namespace furrow::physics {

/// All that stores energy in a cloth: structural and bending springs, membrane triangles, tension, hinges, in
/// this order, each kind in the order of its array. Kinds that are empty cost nothing. x: one position a
/// particle [m], in place of cloth.particles.x; masses, velocities and pins do not count. Cost: one pass.
/// Throw std::invalid_argument, nothing changed, if lengths differ or an element names a particle out of
/// range.

/// The energy E [J].
double potential_energy(const Cloth& cloth, std::span<const Vec3> x);

/// Adds the forces -dE/dx [N]; in total they and their moment are zero.
void add_forces(const Cloth& cloth, std::span<const Vec3> x, std::span<Vec3> force);

/// Hands out the blocks of K = d2E/dx2 [N/m], several for one (i, j) where elements share particles; both
/// (i, j) and (j, i). The sequence of (i, j) depends on the cloth alone, never on x: a sparse matrix can keep
/// its places. K is symmetric; with Stiffness::positive_part each element's share is positive semidefinite.
void add_stiffness(const Cloth& cloth, std::span<const Vec3> x, Stiffness stiffness, const BlockSink& sink);

}  // namespace furrow::physics
