// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

/// A spring between any two vertices, mostly some rings apart: it gives a fold depth to stand on.
struct Strut {
  Vertex a, b;         ///< a < b
  double rest_length;  ///< [m]; > 0, finite
  double stiffness;    ///< [N/m]; >= 0, finite
};

/// The struts of a mesh, sorted by (a, b), those of one pair in the order in which they were set; none where
/// a vertex is not in the mesh any more. They stay with their vertices through insertion and flips;
/// displacement carries their rest lengths along (apply_rest_rule); subdivision drops them. They name
/// vertices by index: code that removes vertices and collects the garbage has to set them anew. Furrow never
/// does.
std::vector<Strut> struts(const Mesh& mesh);

/// Replaces all struts; none are left for an empty list. Copies of the mesh have them, too. Throws
/// std::invalid_argument, the mesh untouched, if a value is out of its range or a vertex not in the mesh.
/// O(struts log struts).
void set_struts(Mesh& mesh, std::span<const Strut> list);

/// Whether the mesh is a chain, or a net of threads: vertices without any face. Its struts are its links.
inline bool is_chain(const Mesh& mesh) { return mesh.number_of_faces() == 0; }
/// By vertex: 1 where neither a face nor, in a chain, a link holds it, so that it has no mass and no motion.
std::vector<char> loose_vertices(const Mesh& mesh);

}  // namespace furrow::geometry
