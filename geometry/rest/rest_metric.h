// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <string>

#include "geometry/mesh/face_point.h"
#include "geometry/mesh/property_names.h"

/// The shape of the unstrained cloth, known by the rest lengths of its edges alone (an intrinsic
/// triangulation). Positions in space play no part: a strained mesh has the same rest metric.
namespace furrow::geometry {

/// Rest lengths of a triangle [m]: entry i joins corner i and corner i + 1.
using TriangleLengths = std::array<double, 3>;

/// The map e:rest_length; edges where it is not set get their length in space.
EdgeMap<double> ensure_rest_lengths(Mesh& mesh);

TriangleLengths rest_lengths_of(const Mesh& mesh, const EdgeMap<double>& rest, Face face);

/// Heron's area [m^2] in Kahan's stable order; 0 where the triangle inequality fails, NaN for NaN.
double triangle_area(const TriangleLengths& lengths);

/// Angles [rad] at the corners 0, 1, 2.
std::array<double, 3> triangle_angles(const TriangleLengths& lengths);
double smallest_angle(const TriangleLengths& lengths);

/// Whether the lengths are finite, > 0, keep the triangle inequality and span at least 1e-12 l^2 of area, l
/// the longest.
bool is_proper_triangle(const TriangleLengths& lengths);

/// Distances [m] of the point of the given barycentrics from the corners: with u = barycentrics - e_i,
/// l_pi^2 = -(l_01^2 u_0 u_1 + l_12^2 u_1 u_2 + l_20^2 u_2 u_0). (Sharp, Soliman, Crane 2019, displacement
/// length.)
std::array<double, 3> lengths_to_corners(const TriangleLengths& lengths, const Barycentrics& barycentrics);

Barycentrics incenter(const TriangleLengths& lengths);

/// Two triangles (a, b, c) and (b, a, d) laid flat: a = (0, 0), b = (length, 0), c above, d below [m].
struct UnfoldedPair {
  double length;
  std::array<double, 2> c, d;
  double flipped_length() const;                ///< |cd|, the rest length of the edge after its flip
  std::array<double, 2> flipped_areas() const;  ///< signed areas of (a, d, c) and (d, b, c) [m^2]
};

/// `edge` must not be on the border.
UnfoldedPair unfold(const Mesh& mesh, const EdgeMap<double>& rest, Edge edge);

/// cot + cot of the two angles opposite an inner edge; < 0 where the edge is not Delaunay.
double cotangent_sum(const Mesh& mesh, const EdgeMap<double>& rest, Edge edge);

}  // namespace furrow::geometry
