// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>

#include "geometry/mesh/border_loops.h"

namespace furrow::geometry {

/// Borders of at most so many edges that are holes. None is that of a part that has no more faces than its
/// border has edges (a loose triangle), nor the outline of a flat piece: what closed it would lie on the
/// faces around it. Longest first. O(edges).
std::vector<BorderLoop> small_holes(const Mesh& mesh, std::size_t most_edges);

/// Closes small_holes() by triangles between their corners. New faces have the
/// defaults of all maps, no vertex is added. Returns how many were closed. Throws ContentError if a face is
/// no triangle. Cost: O(edges) and O(most_edges^3) a hole. Source: P. Liepa, "Filling holes in meshes"
/// (2003), by CGAL.
std::size_t close_small_holes(Mesh& mesh, std::size_t most_edges);

}  // namespace furrow::geometry
