// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

/// Writes attribute::mass: m_i = density * sum of A_j / 3 over the triangles j around vertex i (method S1.8),
/// A_j the area at rest (Heron's formula on the rest lengths; the present length where one is unset). A
/// vertex of no face gets 0. `density` is the mass per unit area [kg/m^2], finite and > 0. Returns the total
/// mass [kg] = density * rest_area(). Throws std::invalid_argument for the density, ContentError for a face
/// that is no triangle or a rest length that is negative or infinite, the mesh untouched. O(vertices +
/// edges).
double lump_masses(Mesh& mesh, double density);

}  // namespace furrow::geometry
