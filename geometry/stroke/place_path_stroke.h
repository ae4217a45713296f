// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <string>

#include "geometry/stroke/placed_stroke.h"

namespace furrow::geometry {

/// Lays a stroke from vertex to vertex along shortest paths over the surface, which are exact for the mesh as
/// a polyhedron (they cross faces, they do not follow edges). `vertices` are indices; one alone is a point.
/// `closed`: the last is joined to the first. Throws ContentError that names stroke and place for an index
/// that the mesh does not have, a vertex of no face, a repeated one, two that no cloth joins, or a degenerate
/// face that the way may lead over. Cost: that
/// of CGAL's continuous Dijkstra over the faces that a path no longer than that along the edges can come to:
/// O(n^2 log n) for n of them at worst, in practice seconds for 1e5.
/// Source: S. Q. Xin, G. J. Wang, ACM Trans. Graph. 28 (2009) 104, as in CGAL's Surface_mesh_shortest_path.
PlacedStroke place_path_stroke(const Mesh& mesh, std::span<const std::size_t> vertices, bool closed,
                               const std::string& stroke_name);

}  // namespace furrow::geometry
