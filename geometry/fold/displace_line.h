// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>

#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

/// Where a line lifts or lowers one vertex.
struct Displacement {
  Vertex vertex;
  Vector normal{0, 0, 1};  ///< n, unit length to 1e-6
  double height = 0;       ///< k [m]; > 0 along n (ridge), < 0 against it (valley); finite
};

/// x += k n for each vertex (method S1.4: n is the unit normal of the triangle that the vertex was inserted
/// in). A vertex that is named twice is displaced twice. Changes positions only; rest lengths, masses and
/// every other map stay. Throws std::invalid_argument, the mesh untouched, if the mesh has not such a vertex,
/// a height or normal is not finite, or a normal is not of unit length.
/// Source: Shi and Saito, step 2 of their Algorithm 1.
void displace_line(Mesh& mesh, std::span<const Displacement> displacements);

}  // namespace furrow::geometry
