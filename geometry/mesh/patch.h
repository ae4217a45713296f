// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

/// A part of a mesh as a mesh of its own. What is at its rim, where the rest of the mesh begins, is a border
/// in it. Indices ascend as they do in the whole, and vertices, edges and faces point to the same halfedges.
struct Patch {
  Mesh mesh;
  std::vector<Vertex> vertices;  ///< of the whole, by index in the patch; ascending, as the next two
  std::vector<Edge> edges;
  std::vector<Face> faces;

  /// By vertex of the patch: it is at the rim. O(edges of the patch).
  std::vector<bool> rim(const Mesh& whole) const;
};

/// The faces as a mesh, with all attributes of the register and those that files bring; no struts. Cost:
/// O(n log n) of the faces given, which ascend.
Patch cut_patch(const Mesh& whole, std::vector<Face> faces);

/// Brings what was made of a patch back: its new elements come after those of the whole, the others keep
/// their indices. Faces at the rim must be as they were. O(n log n) of the patch.
void put_back(const Patch& patch, Mesh& whole);

}  // namespace furrow::geometry
