// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/mesh/mesh.h"
#include "physics/cloth/cloth.h"

namespace furrow::bridge {

/// Writes the particles' positions back to the vertices they were gathered from. All maps stay.
/// Throws std::invalid_argument, the mesh untouched, if the counts differ.
void scatter(const physics::Particles& particles, geometry::Mesh& mesh);
/// The same with their velocities, into v:velocity.
void scatter_velocities(const physics::Particles& particles, geometry::Mesh& mesh);

}  // namespace furrow::bridge
