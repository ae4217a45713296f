// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string>

#include "physics/base/arrays.h"

namespace furrow::physics {

/// Throws std::invalid_argument, with the caller's name before it, if the arrays differ in length, a position
/// is not finite, or a free particle's mass is not > 0 and finite: what no search for rest can begin with.
void check_particles(const Particles& particles, const std::string& caller);

/// The same of a cloth as it lies, under loads [N]: velocities are not asked for, and loads, one a particle
/// or none at all, must be finite. It names the particle.
void check_loaded_particles(const Particles& particles, std::span<const Vec3> loads,
                            const std::string& caller);

}  // namespace furrow::physics
