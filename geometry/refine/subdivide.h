// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "geometry/mesh/mesh_fwd.h"

namespace furrow::geometry {

/// Loop subdivision, `steps` times: every triangle becomes four. Border vertices and edges follow the border
/// curve only (1/8, 3/4, 1/8 and mid-points). Old vertices keep their indices; attributes follow their rules
/// (attribute_register.h): rest lengths that are set are refined, so that the cloth stays as large as it was
/// made (refine_rest.h); where none is set, the new shape is the rest shape. Struts are dropped. `steps` in
/// [0, 6], and at most 50 million faces in the end; they grow as 4^steps. Removed elements are collected
/// first. Throws std::invalid_argument for steps, ContentError for a face that is no triangle, a position
/// that is not finite or a rest length below 0, the mesh untouched.
///
/// \details A mid-point on an edge of a line is a vertex of the line, if both ends are. Halves of diagonals
/// (attribute::diagonal) and the new edges parallel to one are diagonals. Source: C. Loop, "Smooth
/// subdivision surfaces based on triangles" (1987); masks of CGAL's Subdivision_method_3.
void loop_subdivide(Mesh& mesh, int steps);

/// Cuts every triangle into four at the mid-points of its edges, `steps` times: the surface stays what it
/// was. All else as in loop_subdivide. Returns, by the index of each face, the face that it is a part of (as
/// numbered after removed elements are collected).
std::vector<Face> midpoint_subdivide(Mesh& mesh, int steps);

/// Sqrt(3) subdivision, `steps` times: every triangle gets its centroid and old edges are flipped; on every
/// second step border edges are cut in three. Old vertices keep their indices. Attributes as in
/// loop_subdivide, except that new vertices belong to no line and no edge is an edge of a line or a diagonal:
/// old edges are gone. A seam of texture, group or material is flipped away too: a corner takes the texture
/// coordinate that its parent face had there. Range and errors as in loop_subdivide. Faces grow as 3^steps.
/// Source: L. Kobbelt, "sqrt(3)-subdivision", SIGGRAPH 2000; masks of CGAL's Subdivision_method_3.
void sqrt3_subdivide(Mesh& mesh, int steps);

}  // namespace furrow::geometry
