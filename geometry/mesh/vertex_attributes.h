// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "geometry/mesh/property_names.h"

namespace furrow::geometry {

/// A number at each vertex that means nothing to us: a skin weight, a mask, a measured value. Readers keep
/// them by their names in the file, insertion and subdivision interpolate them, writers give them back.
struct VertexAttribute {
  std::string name;          ///< without our prefix "v:attribute:"; unique in a mesh, no white space
  VertexMap<double> values;  ///< a handle: writing through it changes the mesh
};

/// All attributes of a mesh, in the order in which they were added.
std::vector<VertexAttribute> vertex_attributes(const Mesh& mesh);

/// The attribute of that name, added with 0 everywhere if the mesh has none.
VertexMap<double> ensure_vertex_attribute(Mesh& mesh, const std::string& name);

/// Rest positions, added and set to the positions where a vertex has none: before the cloth moves or lines
/// are drawn.
VertexMap<RestPosition> ensure_rest_positions(Mesh& mesh);

/// The attribute that holds how far a shape key moves vertices along an axis, 0 to 2 [m], y up. `key` has no
/// white space.
std::string key_attribute(const std::string& key, int axis);
/// The names of a mesh's shape keys, in the order in which they were added.
std::vector<std::string> shape_key_names(const Mesh& mesh);
/// How far a shape key moves each vertex, by index [m]; 0 where the mesh has no such key.
std::vector<Vector> shape_key(const Mesh& mesh, const std::string& key);
/// Gives a mesh a shape key, or another shape to one that it has. Throws std::invalid_argument for a name
/// without a letter or with white space, or where `moves` are not those of all vertices.
void set_shape_key(Mesh& mesh, const std::string& key, const std::vector<Vector>& moves);

/// Skin weights are the attributes "weight_<joint>". Keeps the `strongest` largest of each vertex (0: all;
/// at equal weight the joint added first), sets the others to 0 and divides by the sum. A vertex that loses
/// none and whose weights sum to 1 within 1e-6 keeps its bits; one without any weight too. Returns how many
/// vertices were changed. Throws std::invalid_argument for strongest < 0, ContentError for a weight that is
/// negative or not finite; the mesh is unchanged then. O(vertices × joints).
std::size_t normalize_skin_weights(Mesh& mesh, int strongest = 0);

}  // namespace furrow::geometry
