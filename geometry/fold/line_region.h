// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

/// How much longer a way along edges may be than the straight one: 2 / sqrt(3) at most on equilateral
/// triangles.
inline constexpr double largest_detour = 1.2;

/// Length of every edge before any line was drawn [m], by edge index (0 for removed edges): the distance of
/// attribute::rest_position where both ends have one, else rest_lengths(). A fold's own cloth does not count,
/// so a region measured by these stays the same while its line is raised, lowered or worn. Throws as
/// rest_lengths().
std::vector<double> lengths_before_lines(const Mesh& mesh);

/// Vertices that a way along edges of at most `reach` [m] joins to one of `seeds`, the seeds among them, each
/// once, by ascending index: Dijkstra's search by `length_of_edge` [m], by edge index. Throws
/// std::invalid_argument if the reach is not >= 0 or the mesh has not such a seed. O(n log n) of the result,
/// O(vertices) once.
std::vector<Vertex> vertices_within(const Mesh& mesh, std::span<const Vertex> seeds, double reach,
                                    const std::vector<double>& length_of_edge);

/// The cloth that a line of a width [m] moves, is measured on, and is pressed on: vertices within
/// largest_detour width / 2 of the line's along edges, and two_ring() of the line at least; exactly that
/// where the width is not > 0 (NaN: none). `length_of_edge` should be lengths_before_lines(). Throws as
/// vertices_within().
std::vector<Vertex> line_region(const Mesh& mesh, std::span<const Vertex> line, double width,
                                const std::vector<double>& length_of_edge);

}  // namespace furrow::geometry
