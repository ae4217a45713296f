// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

/// One closed curve of border edges: a hem, a neck, an arm hole.
struct BorderLoop {
  std::vector<Vertex> vertices;  ///< in order, the border on the left hand of outside; the lowest index first
  double length = 0;             ///< in space [m]
  double mean_height = 0;        ///< mean y along the curve [m]; of its vertices if the length is 0
  double mean_radius = 0;        ///< mean horizontal (x, z) distance of its vertices from their mean [m]
};

/// All border loops, longest first; of equal length, the one with the lower first vertex first. O(edges).
std::vector<BorderLoop> border_loops(const Mesh& mesh);

/// Index of the loop that a user names: "top" (highest mean_height), "bottom" (lowest), or its index in
/// `loops`. Throws std::invalid_argument that lists the choices.
std::size_t find_border_loop(std::span<const BorderLoop> loops, std::string_view name);

/// Length of the loop at rest [m]: the sum of the rest lengths of its edges (the present length where unset).
/// Throws std::invalid_argument if two consecutive vertices of the loop are not joined by an edge.
/// Cost: O(edges of the mesh), which the second form saves: it takes them, rest_lengths(mesh), for many
/// loops.
double rest_length(const Mesh& mesh, const BorderLoop& loop);
double rest_length(const Mesh& mesh, const BorderLoop& loop, const std::vector<double>& lengths);

}  // namespace furrow::geometry
