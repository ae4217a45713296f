// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "geometry/mesh/mesh.h"

namespace furrow::bridge {

/// What physics::Tension::stretch [N] is on each edge, by its index, so that cloth answers alike on every
/// mesh. c is the force that a metre of width takes at the strain 1: a sheet that is pulled by the strain e
/// along its threads, or by e in all directions, pulls back with c e^2 [N/m]. An edge of length L stands for
/// cloth A / L wide in a triangle of area A beside it, so it gets
///   c sum over its triangles s A / L,
/// in a triangle with a diagonal (e:diagonal)  s = 1 for the threads, `shear` for the diagonal;
/// in a triangle without                       s = 2/3: three directions share what two threads bear.
/// Stored are (2 + shear) / 3 c e^3 or 2/3 c e^3 [J/m^2] at the strain e in all directions on any mesh, so
/// woven cloth pulls with (1 + shear / 2) c e^2 then. Pulled along one direction with free sides a lattice
/// without threads takes 2/3 c e^2 only: its other edges turn instead of stretching. Lengths and areas are
/// those at rest. A triangle of no area gives nothing. The paper has one constant an edge whatever the mesh;
/// all of this is ours (method S2.2).
/// c: [N/m], > 0; shear: [-], in [0, 1]. Throws std::invalid_argument otherwise, ContentError for a face that
/// is no triangle. O(edges).
std::vector<double> tension_constants(const geometry::Mesh& mesh, double c, double shear);

}  // namespace furrow::bridge
