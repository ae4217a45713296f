// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

/// The signed angle between the two faces of an interior edge as they lie [rad], in (-pi, pi]: 0 flat, > 0 a
/// ridge seen from the normals' side; 0 for a border edge or where a face has no area.
double dihedral_angle(const Mesh& mesh, Edge edge);

/// Gives every interior edge whose attribute::rest_angle is unset (all of them where the map is missing) the
/// angle of the present shape; the others keep their bits. Insertion and flips unset the angles of the edges
/// whose faces they change, displacement carries the rest along (apply_rest_rule). Cost: one pass over the
/// edges.
void ensure_rest_angles(Mesh& mesh);

}  // namespace furrow::geometry
