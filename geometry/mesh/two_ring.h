// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

/// Vertices at most `rings` edges away from one of `seeds`, the seeds among them, each once, by ascending
/// index. Cost: a byte for each vertex of the mesh, and the edges around the result. Throws
/// std::invalid_argument if rings < 0 or the mesh has not such a seed.
std::vector<Vertex> vertices_within_rings(const Mesh& mesh, std::span<const Vertex> seeds, int rings);

/// The neighbourhood that a drawn line is smoothed in (method S1.5): vertices_within_rings(mesh, seeds, 2).
std::vector<Vertex> two_ring(const Mesh& mesh, std::span<const Vertex> seeds);

/// Vertices of all lines (attribute::line >= 0), by ascending index.
std::vector<Vertex> line_vertices(const Mesh& mesh);

}  // namespace furrow::geometry
