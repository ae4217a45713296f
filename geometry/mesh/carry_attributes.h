// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <functional>
#include <vector>

#include "geometry/mesh/attribute_slots.h"
#include "geometry/mesh/face_point.h"
#include "geometry/mesh/vertex_attributes.h"

/// What happens to the attributes of a mesh where its connectivity changes, by the rules of the register.
namespace furrow::geometry {

/// Everything at vertices that is interpolated where a vertex is added: attributes of the rule blend, and
/// what files bring (vertex_attributes.h).
class VertexBlend {
 public:
  /// Takes handles of the maps that the mesh has now. `rule`: &Carry::insertion or &Carry::subdivision.
  VertexBlend(const Mesh& mesh, CarryRule Carry::*rule) : VertexBlend(mesh, mesh, rule) {}
  /// The same with values of another mesh, `before`, that has the same maps.
  VertexBlend(const Mesh& before, const Mesh& mesh, CarryRule Carry::*rule);
  /// Sets the values of `to` to the weighted sum of those of three vertices (sum of weights 1). A weight of
  /// exactly 0 leaves its vertex out, NaN or not. O(number of maps).
  void set(Vertex to, const std::array<Vertex, 3>& from, const Barycentrics& weights) const;

 private:
  AttributeMaps<Vertex> registered_;
  CarryRule Carry::*rule_;
  std::vector<VertexAttribute> others_before_, others_;
};

/// The rules for insertion, element by element; what has the rule computed is left alone. Takes handles of
/// the maps that the mesh has now. Each function is O(number of maps).
class EditedAttributes {
 public:
  explicit EditedAttributes(const Mesh& mesh);
  void blend(Vertex to, const std::array<Vertex, 3>& from, const Barycentrics& weights) const {
    vertices_.set(to, from, weights);
  }
  /// `part` is a part of what `whole` was.
  void copy(Face whole, Face part) const;
  /// `edge` was cut in two: the rest of it keeps its index, `half` is new.
  void halve(Edge edge, Edge half) const;
  void flip(Edge edge) const;
  /// `edge` is a side of a changed face.
  void change(Edge edge) const;
  /// The corners of `face` changed.
  void change(Face face) const;

 private:
  const Mesh& mesh_;
  VertexBlend vertices_;
  AttributeMaps<Face> faces_;
  AttributeMaps<Edge> edges_;
  AttributeMaps<Halfedge> halfedges_;
};

/// A point of the mesh before: a face and weights of its three corners (from target(halfedge(f)) onwards).
struct Origin {
  Face face;
  std::array<double, 3> weights{0, 0, 0};  ///< sum 1
};

/// A mesh before a step of a subdivision. Triangles only, no removed elements.
class SavedAttributes {
 public:
  explicit SavedAttributes(const Mesh& mesh);
  const Mesh& before() const { return before_; }
  /// Corner of `face` that the vertex is at, in [0, 3); 3 if it is at none.
  std::size_t corner(Face face, Vertex v) const;
  /// Sets all attributes of the finer mesh by the rules for subdivision. parent(f) is the old face that face
  /// f lies in, origin(v, parent) where its corner v lay. Edges get their defaults; struts are dropped.
  void restore(Mesh& mesh, const std::function<Face(Face)>& parent,
               const std::function<Origin(Vertex, Face)>& origin) const;
  /// After restore(): both halves of each old edge get what it had, by the rule halves. Old edge i was cut at
  /// the vertex i + number of old vertices.
  void restore_halves(Mesh& mesh) const;

 private:
  void restore_vertices(Mesh& mesh) const;
  void restore_faces(Mesh& mesh, const std::function<Face(Face)>& parent) const;
  void restore_corners(Mesh& mesh, const std::function<Face(Face)>& parent,
                       const std::function<Origin(Vertex, Face)>& origin) const;
  Mesh before_;
  std::vector<std::array<Vertex, 3>> corners_;
};

}  // namespace furrow::geometry
