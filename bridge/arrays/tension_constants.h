// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "geometry/mesh/mesh.h"

namespace furrow::bridge {

/// The physics::Tension::stretch [N] of each edge, by its index, with which cloth answers alike on every
/// mesh. c [N/m], > 0, is the force that a metre of width takes at the strain 1: a sheet that is pulled by
/// the strain e along its threads, or by e in all directions, pulls back with c e^2. shear [-], in [0, 1]:
/// that of a diagonal over that of threads. O(edges). Throws std::invalid_argument for a value out of its
/// range, ContentError for a face that is no triangle.
///
/// \details An edge of length L stands for cloth A / L wide in a triangle of area A beside it, so it gets c
/// times the sum over its triangles of s A / L. In a triangle with a diagonal (e:diagonal) s is 1 for the
/// threads and `shear` for the diagonal. In a triangle without one s is 2/3: three directions share what two
/// threads bear. Lengths and areas are those at rest; a triangle of no area gives nothing. The paper has one
/// constant an edge whatever the mesh; all of this is ours (method S2.2).
///
/// At the strain e in all directions (2 + shear) / 3 c e^3 or 2/3 c e^3 [J/m^2] is stored on any mesh, so
/// woven cloth then pulls with (1 + shear / 2) c e^2. Pulled along one direction with free sides a lattice
/// without threads takes 2/3 c e^2 only: its other edges turn instead of stretching.
std::vector<double> tension_constants(const geometry::Mesh& mesh, double c, double shear);

}  // namespace furrow::bridge
