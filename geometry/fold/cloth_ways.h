// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <utility>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

/// A vertex, and how far it is from given ones along the cloth [m].
using VertexWay = std::pair<Vertex, double>;

/// The vertices that are within `reach` [m] of `seeds` along the surface, ascending. A front passes straight
/// through a face from the two corners that it came to first (Kimmel, Sethian 1998), or along its sides: from
/// a straight chain on a flat sheet the ways are the distances, elsewhere up to an eighth too long. Layers
/// that lie on each other are far apart. Lengths are those of the mesh's positions. Throws
/// std::invalid_argument for a seed that is not in the mesh and for reach < 0. O(n log n) of the vertices
/// within, O(mesh) once.
std::vector<VertexWay> ways_along_cloth(const Mesh& mesh, std::span<const Vertex> seeds, double reach);

}  // namespace furrow::geometry
