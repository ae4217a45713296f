// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>

#include "geometry/mesh/mesh.h"
#include "meshes/implicit_shapes.h"

namespace furrow::meshes {

using Solid = std::function<double(const Vec&)>;  ///< < 0 inside

/// The surface of a solid by marching tetrahedra (Doi & Koide 1991), six to each cube of a lattice of this
/// `cell` [m]: closed, wound outward, with many thin triangles. The box from `low` to `high` must hold all of
/// it; parts thinner than a cell may be lost. O(cells).
geometry::Mesh march(const Solid& solid, const Vec& low, const Vec& high, double cell);

}  // namespace furrow::meshes
