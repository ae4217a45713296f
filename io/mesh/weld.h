// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "io/mesh/mesh_file.h"

namespace furrow::io {

/// The file with vertices at exactly the same place joined into the first of them, and those without faces
/// left out; then as read from a file: faces that come to be twice there are dropped, neighbours wound alike,
/// what is not manifold parted (`repairs`). Colours and vertex attributes are those of the first vertex;
/// texture, groups and materials stay; what edges and triangles had (rest lengths, struts) is left out.
/// Throws geometry::ContentError if a face is no triangle or none is left. O(F log F).
MeshFile welded(const MeshFile& file, const std::string& name);

}  // namespace furrow::io
