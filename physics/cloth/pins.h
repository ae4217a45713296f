// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include "physics/cloth/cloth.h"

namespace furrow::physics {

/// Pins the particles: inv_mass = 0 and v = 0; the mass stays (it still counts as weight). Repeats are
/// harmless. Throws std::invalid_argument, nothing changed, if an index is out of range.
void pin(Particles& particles, std::span<const int> indices);

/// Leaves out the elements all of whose particles are pinned: they push nothing that moves, and a search for
/// rest that frees a few particles need not look at them. The energy is less by what they had. Riders and
/// triangles stay.
void drop_held_elements(Cloth& cloth);

/// Doubles the stiffness of the hinges of a clamp: both ends of the edge and one flap are pinned, the other
/// flap is free. Such a hinge stands for half a cell only; taken singly it makes a clamped strip 26 to 35 %
/// too limp at 8 cells, 13 to 17 % at 16 (w L^3 / B from 1 to 25): the error falls with the first power of
/// the cell instead of the second. Once for a new cloth, when all its pins are set.
void stiffen_clamps(Cloth& cloth);
/// Its inverse, exactly: halves what stiffen_clamps doubled, with the same pins. For callers that keep the
/// hinges' stiffness elsewhere.
void soften_clamps(Cloth& cloth);

}  // namespace furrow::physics
