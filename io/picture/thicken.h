// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "io/picture/prepared_scene.h"

namespace furrow::io {

/// Gives cloth a thickness for a picture: an outer and an inner copy, half the thickness before and behind
/// the surface along its normals, and along borders a half-round strip of four quads that joins them, so that
/// a hem is seen as an edge of cloth. The outer triangles keep their indices; the inner ones follow, then the
/// strips (first_inner, first_rim). Colours, textures and bulges go along; an inner bulge is the negative.
/// `half`: half the thickness in the units of the prepared mesh, > 0. Cost: linear, after a sort of the
/// edges.
void thicken(PreparedMesh& mesh, double half);

/// Splits normals along edges whose dihedral is above 60 degrees, so that a pressed edge is seen as one: a
/// corner takes the mean, weighted by angle, of the triangles that it reaches without crossing such an edge.
/// Adds to `normals` and fills `corners` if there is any. To be called before thicken().
void split_normals(PreparedMesh& mesh);

/// An edge of two triangles or of one: its first triangle, with the corner where it begins there.
struct MeshSide {
  int low, high;         ///< its vertices
  int triangle, corner;  ///< it leads from this corner to the next one
};
/// The sides of all triangles, ordered by vertices and then by triangle.
std::vector<MeshSide> sorted_sides(const PreparedMesh& mesh);

}  // namespace furrow::io
