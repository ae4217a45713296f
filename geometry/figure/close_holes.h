// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>

#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

/// Closes the holes of at most so many border edges by triangles between their corners; a part of the mesh
/// that has no more faces than its border has edges (a loose triangle) is left alone. New faces have the
/// defaults of all maps, no vertex is added. Returns how many were closed. Throws ContentError if a face is
/// no triangle. Cost: O(edges) and O(most_edges^3) a hole. Source: P. Liepa, "Filling holes in meshes"
/// (2003), by CGAL.
std::size_t close_small_holes(Mesh& mesh, std::size_t most_edges);

}  // namespace furrow::geometry
