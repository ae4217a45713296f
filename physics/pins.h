// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include "physics/particles.h"

namespace furrow::physics {

/// Pins the particles: inv_mass = 0 and v = 0; the mass stays (it still counts as weight). Repeats are
/// harmless. Throws std::invalid_argument, nothing changed, if an index is out of range.
void pin(Particles& particles, std::span<const int> indices);

}  // namespace furrow::physics
