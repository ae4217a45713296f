// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "bridge/arrays/gather.h"

namespace furrow::bridge {

/// The inverse of gather() for the rest state: writes rest lengths, rest angles and stiffnesses of a cloth,
/// element by element, into the maps of the mesh that it was gathered from with these options. Then
/// gather(mesh, options) gives the same elements again, bit for bit. Positions, velocities and masses stay
/// (bridge/arrays/gather.h). O(edges log edges). Throws std::invalid_argument, the mesh untouched, if the
/// elements are not those of the mesh, a triangle has other Lame parameters than the options give, or a value
/// is out of the range that physics/cloth/cloth.h states; and as gather() does.
///
/// \details Springs of the membrane go to e:rest_length and e:stiffness, tension to e:rest_length and
/// e:tension, triangles to h:rest_length (e:rest_length keeps the metric that masses and areas are made of),
/// cross springs to e:bending_rest_length and e:bending_stiffness, hinges to e:rest_angle and
/// e:hinge_stiffness; hinges of a plate to e:rest_angle and, where their presses are not those of the lines,
/// e:press, for with a stiffness of their own they would leave it. Bending springs that the mesh does not
/// have are struts, in any order, behind the cross spring of their pair if there is one; they replace the
/// mesh's (geometry/mesh/struts.h).
///
/// What is stored goes before the material: options of another stiffness act only where a map is unset. After
/// physics::stiffen_clamps call soften_clamps first, or clamps count twice the next time.
void store_rest_state(const physics::Cloth& cloth, const GatherOptions& options, geometry::Mesh& mesh);

}  // namespace furrow::bridge
