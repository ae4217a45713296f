// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

/// A spring that joins the two vertices opposite an interior edge (method S1.1).
struct BendingSpring {
  Vertex a, b;  ///< a < b
  Edge across;  ///< the edge that holds it in attribute::bending_rest_length and attribute::bending_count
  double rest_length;  ///< [m]
  int count;  ///< edges whose opposite vertices are a and b; >= 1 (2 around a vertex of valence four)
};

/// Writes attribute::bending_rest_length and attribute::bending_count of the whole mesh. Every interior edge
/// asks for a spring between the two vertices opposite it; it gets none where an edge joins them already or
/// both are the same vertex. Edges with the same two opposite vertices share one spring: the edge with the
/// smallest pair of ends (lower end first) holds it, the others hold NaN and 0. Rest length: the present
/// distance in space [m]; attribute::bending_stiffness, if there is one, becomes unset. Changes no position
/// and no connectivity. O(edges log edges). Throws ContentError if a face is no triangle. Source: Shi and
/// Saito, section 3 (the springs are rebuilt after the flips).
void rebuild_bending_springs(Mesh& mesh);
/// rebuild_bending_springs(mesh), unless the mesh has bending springs already: those keep their rest lengths.
/// Rest lengths and stiffnesses that are set on edges without a count (a file's own columns) are taken over
/// by the springs made; of edges that share one, the first that is set.
void ensure_bending_springs(Mesh& mesh);

/// The same where connectivity changed. `changed` holds every face that was added or has got other corners
/// since the last rebuild (more do no harm). The springs are those of a whole rebuild. A spring that was held
/// across an edge between two faces not in `changed` keeps its rest length, and its stiffness (if it has one
/// and its count stays); all others around `changed` are measured anew, their stiffness unset. Cost: the
/// faces around the vertices of `changed`. Throws std::invalid_argument, nothing changed, for a face that the
/// mesh has not; ContentError if a face around is no triangle.
void rebuild_bending_springs(Mesh& mesh, std::span<const Face> changed);

/// The springs that the maps hold, sorted by (a, b); none if the mesh has no such maps.
std::vector<BendingSpring> bending_springs(const Mesh& mesh);
/// How many they are. O(edges).
std::size_t count_bending_springs(const Mesh& mesh);

}  // namespace furrow::geometry
