// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "geometry/mesh/mesh.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/vertex_attributes.h"

namespace furrow::geometry {

/// A point of the mesh before: a face and weights of its three corners (from target(halfedge(f)) onwards).
struct Origin {
  Face face;
  std::array<double, 3> weights{0, 0, 0};  ///< sum 1
};

/// Texture coordinates, groups and materials of a mesh before its faces are replaced by finer ones. What its
/// vertices carry (VertexBlend) stays with the old vertices meanwhile.
/// Triangles only, no removed elements.
class SavedAttributes {
 public:
  explicit SavedAttributes(const Mesh& mesh);
  /// Corner of `face` that the vertex is at, in [0, 3); 3 if it is at none.
  std::size_t corner(Face face, Vertex v) const;
  const std::array<Vertex, 3>& corners(Face face) const { return corners_[face.idx()]; }
  /// Sets every face, corner and new vertex (index >= the number of old ones) of the finer mesh.
  /// parent(f) is the old face that face f lies in, origin(v, parent) where its corner v lay.
  void restore(Mesh& mesh, const std::function<Face(Face)>& parent,
               const std::function<Origin(Vertex, Face)>& origin) const;

 private:
  TextureCoordinate texture_at(const Origin& at) const;
  std::size_t old_vertices_;
  std::vector<std::array<Vertex, 3>> corners_;
  std::vector<std::array<TextureCoordinate, 3>> texture_;  // empty: the mesh has none; the same below
  std::vector<int> group_, material_;
};

/// Rest lengths and angles, bending springs, stiffnesses and masses of the whole mesh become unset, where the
/// mesh has such maps; its struts are dropped.
void unset_rest_state(Mesh& mesh);

}  // namespace furrow::geometry
