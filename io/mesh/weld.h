// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "io/mesh/mesh_file.h"

namespace furrow::io {

/// The file with vertices at exactly the same place joined into the first of them, and those without faces
/// left out; then seams that lie open by a rounding (geometry::find_border_seams()): each pair becomes its
/// first vertex, and where a vertex lies amid an edge, the face there is split, its texture blended. Then as
/// read from a file: faces that come to be twice there are dropped, neighbours wound alike, what is not
/// manifold parted (`repairs`). Vertices and faces keep their order; colours and vertex attributes are those
/// of the first vertex; texture, groups and materials stay; what edges and triangles had (rest lengths,
/// struts) is left out, but for the diagonals of quads. Throws geometry::ContentError if a face is no
/// triangle or none is left. O(F log F).
MeshFile welded(const MeshFile& file, const std::string& name);

/// The file as it was read, with the open seams within its groups joined, without splits, and a warning that
/// says so; itself where it has none. Its repairs stay, with what was joined as `merged_vertices`. Throws as
/// welded().
MeshFile with_joined_seams(MeshFile file, const std::string& name);

/// The file with all its open seams joined, also those without a gap, and faces split where vertices of a
/// seam lie amid their edges, with a warning that says so. Every vertex of the file stays: one that is joined
/// to another has no face any more, and says with which it is one (attribute::joined). What reading doubled
/// there is one again. Itself where it has no such seam, and where edges have rest lengths. Throws as
/// welded().
MeshFile with_seams_as_one(MeshFile file, const std::string& name);

}  // namespace furrow::io
