// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

/// The shortest path over the surface from one vertex to another, exact for the mesh as a polyhedron: its
/// points on edges and at vertices, in order, from the first vertex to the second [m]; between two of them it
/// is straight. Empty if no faces join the two. Both must be vertices of triangles; their cost and source
/// stand at place_path_stroke.h.
std::vector<Point> shortest_path(const Mesh& mesh, Vertex from, Vertex to);

}  // namespace furrow::geometry
