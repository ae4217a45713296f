// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include "geometry/mesh/mesh.h"

/// Lengths, areas and cotangents of triangles that are known by the lengths of their edges only.
namespace furrow::geometry {

/// Present length of an edge in space [m].
double spatial_length(const Mesh& mesh, Edge e);

/// Rest length of every edge [m], by edge index (entries of removed edges are 0): attribute::rest_length
/// where it is set, the present length where it is not. Throws ContentError if a rest length that is set is
/// negative or infinite.
std::vector<double> rest_lengths(const Mesh& mesh);

/// Lengths of the edges of a triangle: of edge(h), edge(next(h)), edge(prev(h)) with h = halfedge(f).
std::array<double, 3> edge_lengths(const Mesh& mesh, Face f, const std::vector<double>& length_of_edge);

/// Area of the triangle of edges a, b, c [m^2]; 0 where they break the triangle inequality.
/// Stable for needles: W. Kahan, "Miscalculating area and angles of a needle-like triangle" (2014).
double triangle_area(double a, double b, double c);

/// Cotangents of the angles opposite the edges a, b, c, all scaled by one factor <= 1 so that none passes
/// +-100; all zero for a triangle without area. Scaled together they keep the Laplacian of the triangle
/// positive semi-definite, which cutting them off one by one does not.
std::array<double, 3> bounded_cotangents(double a, double b, double c);

}  // namespace furrow::geometry
