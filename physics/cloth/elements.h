// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include "physics/cloth/cloth.h"
#include "physics/cloth/stiffness.h"

namespace furrow::physics {

/// All that stores energy in a cloth: the kinds of elements in the order of for_each_kind(), each in the
/// order of its array, then Cloth::energies. Kinds that are empty cost nothing. x: one position a particle
/// [m], in place of cloth.particles.x; masses, velocities and pins do not count. Cost: one pass.
/// Throw std::invalid_argument, nothing changed, if lengths differ, an element names a particle out of range
/// or its rest state makes no element (check() of each kind), or an energy is null.
/// \details A kind is a struct, an array in Cloth, a line in for_each_kind() and a set of overloads in its
/// header, which take the law that its elements share last, if they have one, but for what is written to:
///   vertices(e)                         its particles, an array
///   renumber(e, place)                  gives it place[i] for each particle i
///   fields(e)                           all numbers that say what it does, for fingerprints
///   check(e, particles)                 throws std::invalid_argument
///   energy(x, e), add_forces(x, e, f)   [J]; [N], which returns the energy, too
///   stiffness_blocks(x, e, part, lower) blocks of K on and below the diagonal
/// and where they differ from nothing, or from the positive part:
///   edges(e), edge_stiffness(e)         edges that stretch, as springs, for strain and damping
///   stiffness_bound_blocks(x, e, lower) for limits of steps

/// The preconditions of all elements in a cloth of so many particles.
void check_elements(const Cloth& cloth, std::size_t particles);

/// The energy E [J].
double potential_energy(const Cloth& cloth, std::span<const Vec3> x);

/// Adds the forces -dE/dx [N]; those of elements and their moment are zero in total.
void add_forces(const Cloth& cloth, std::span<const Vec3> x, std::span<Vec3> force);

/// Hands out the blocks of K = d2E/dx2 [N/m], several for one (i, j) where elements share particles; both
/// (i, j) and (j, i). The sequence of (i, j) depends on the cloth alone, never on x: a sparse matrix can keep
/// its places. K is symmetric; with Stiffness::positive_part each element's share is positive semidefinite.
/// An energy without stiffness is left out.
void add_stiffness(const Cloth& cloth, std::span<const Vec3> x, Stiffness stiffness, const BlockSink& sink);

/// Whether all of Cloth::energies know their stiffness at the cloth's positions. Cost: a pass of theirs.
bool has_all_stiffness(const Cloth& cloth);

}  // namespace furrow::physics
