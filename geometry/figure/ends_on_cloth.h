// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

/// A vertex of a border that lies on other cloth, as the garment was made.
struct EndOnCloth {
  Vertex vertex;
  Face face;        ///< nearest to it
  double distance;  ///< [m]
};

/// Finds the ends that lie on cloth and are not joined to it: a strap under a bib, a wrapped front, the rim
/// of a pocket that was drawn on. A vertex of a border is one of these where it lies within 4 mm of a face
/// (0.1 mm and nearer is a seam, see border_seams.h), and no border of that cloth is as near, for a slit lies
/// open on purpose, unless the borders turn away from each other at both ends. That face belongs to the same
/// part, faces as the vertex's does and lies more than 100 mm away along the cloth; or to a part of at least
/// four times the area, faces either way. Three in a row are needed. Places are those of
/// attribute::rest_position where that is known. What rides or was chosen to go by itself (attached_parts.h),
/// and what a strut holds, is none. Ascending by vertex. Cost: O(faces log faces), and what lies within 100
/// mm of each that cloth is near to. Throws as find_parts().
std::vector<EndOnCloth> find_ends_on_cloth(const Mesh& mesh);

/// Ties each to the corners of its face by struts of the stiffness [N/m], as long as they are as made; they
/// are added to those that the mesh has. Nothing without ends. O(struts log struts).
void tie_ends(Mesh& mesh, const std::vector<EndOnCloth>& ends, double stiffness);

}  // namespace furrow::geometry
