// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/refine/bake_maps.h"

namespace furrow::geometry {

/// Cuts every triangle into 4^steps (midpoint_subdivide) and moves the vertices by a baked displacement map:
/// the counterpart of bake_maps(), of whose `low` mesh this must be the shape. The map is interpolated
/// between the middles of its texels; a vertex on a seam takes the mean of what its charts say, so the cloth
/// stays in one piece; corners without texture coordinates say 0. The frames are those of the mesh before it
/// is subdivided. Throws as midpoint_subdivide, ContentError if the mesh has no texture coordinates,
/// std::invalid_argument if the map's texels do not match its size; the mesh is unchanged then.
void apply_displacement(Mesh& mesh, const VectorMap& displacement, int steps);

}  // namespace furrow::geometry
