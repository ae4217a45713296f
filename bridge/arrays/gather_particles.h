// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "bridge/arrays/gather.h"

namespace furrow::bridge {

/// Particle i is vertex i: positions, velocities of v:velocity (0 without that map), masses. A vertex without
/// faces gets mass 0 and stays where it is. Throws std::invalid_argument without a map v:mass, ContentError
/// for a mass that is not > 0. O(vertices).
physics::Particles gather_particles(const geometry::Mesh& mesh, MassRule rule);

}  // namespace furrow::bridge
