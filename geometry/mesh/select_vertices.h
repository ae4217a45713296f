// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "geometry/mesh/mesh.h"

/// Ways to name vertices, for pins and for what is smoothed. All return vertices in the order of their
/// indices.
namespace furrow::geometry {

/// Vertices with low <= position <= high in every coordinate [m]; the corners may be given in any order.
std::vector<Vertex> vertices_in_box(const Mesh& mesh, const Point& low, const Point& high);

/// Vertices of the faces whose f:group is `group` (an index into the group names).
std::vector<Vertex> vertices_of_group(const Mesh& mesh, int group);

}  // namespace furrow::geometry
