// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <utility>
#include <vector>

#include "geometry/insert/insertion.h"
#include "geometry/insert/mesh_editor.h"

namespace furrow::geometry {

/// Algorithm 2 of method S1.3 on given faces: a vertex at the given barycentrics in each, then each original
/// inner edge of a selected face flipped once, those between two selected faces first, then by the order
/// given. On all faces of a closed mesh with centroids and the paper's rule this is the topology of one
/// sqrt(3) subdivision. The safe rule clamps the barycentrics to at least min_barycentric, guards the flips
/// (flip_rules.h) and restores the Delaunay property beside the new vertices. Keeps the rest metric and all
/// maps (mesh_editor.h). O(faces log faces). Throws std::invalid_argument for an option, a face given twice,
/// or barycentrics that are not > 0 with sum 1; ContentError for a degenerate face or a mesh that is not of
/// triangles. The mesh is unchanged then.
InsertionReport insert_in_faces(Mesh& mesh, std::span<const FacePoint> points,
                                const InsertionOptions& options = {});

/// The nearest barycentrics on the way to the centroid with no weight below `least` (in [0, 1/3]).
Barycentrics clamped(const Barycentrics& barycentrics, double least);

/// The inner edges of the faces that `selected` holds: shared by two of them first, then by the order of
/// faces. `skip` is left out.
std::vector<Edge> edges_in_flip_order(const Mesh& mesh, std::span<const Face> selected,
                                      const std::set<Edge>& skip);

/// Flips each edge that refusal_of_flip allows, in order, and counts.
void flip_edges(MeshEditor& editor, std::span<const Edge> edges, const InsertionOptions& options,
                InsertionReport& report);

/// Fills in what the report says about the mesh afterwards: changed faces, smallest angle.
void conclude(const MeshEditor& editor, InsertionReport& report);

/// Throws ContentError if a face's rest lengths make no proper triangle, or if it has no area in space.
void check_face(const Mesh& mesh, const EdgeMap<double>& rest, Face face);

}  // namespace furrow::geometry
