// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <set>
#include <vector>

#include "geometry/insert/texture_maps.h"
#include "geometry/mesh/carry_attributes.h"
#include "geometry/rest/rest_metric.h"

namespace furrow::geometry {

/// The three local operators of insertion on a triangle mesh. Each sets, beside the half-edges, the position
/// and the rest lengths, and carries every attribute of the mesh by its rule for insertion
/// (attribute_register.h). Texture coordinates are interpolated in the corners; a split face counts one
/// generation more, a flip gives both faces the larger. Each operator is O(valence).
class MeshEditor {
 public:
  /// Adds the maps for rest lengths (in-space lengths where unset), rest positions (positions where unset),
  /// lines, line edges and generations.
  explicit MeshEditor(Mesh& mesh);

  /// Splits a face in three at a point strictly inside.
  Vertex split_face(const FacePoint& point);
  /// Splits the edge of a halfedge that has a face at t in (0, 1) from its source, and its faces with it.
  /// Both halves keep what the edge was (a line edge, a seam, a border).
  Vertex split_edge(Halfedge halfedge, double t);
  /// Flips an inner edge; it is no line edge afterwards. The caller has asked the flip rules.
  void flip_edge(Edge edge);
  /// Sets the texture coordinate of all corners at a vertex that lies on no seam; nothing without texture.
  void set_texture(Vertex vertex, const CornerTexture& at);
  /// A vertex was moved on the cloth: the edges and faces around it are no more what they were.
  void note_moved(Vertex vertex);

  const Mesh& mesh() const { return mesh_; }
  const EdgeMap<double>& rest() const { return rest_; }
  VertexMap<int>& line() { return line_; }
  const VertexMap<int>& line() const { return line_; }
  EdgeMap<bool>& line_edge() { return line_edge_; }
  const EdgeMap<bool>& line_edge() const { return line_edge_; }
  const FaceMap<int>& generation() const { return generation_; }
  /// Texture coordinates, group, material or lining differ across this inner edge (NaN equals NaN).
  bool is_seam(Edge edge) const;
  /// In each texture map of the mesh, the areas of the two faces of an inner edge that is no seam, and of the
  /// two that a flip would make, twice each, signed: (a, b, c), (b, a, d), (a, d, c), (d, b, c).
  std::vector<std::array<double, 4>> texture_areas(Edge edge) const;
  /// The edge that joins two vertices.
  std::optional<Edge> edge_between(Vertex a, Vertex b) const;
  /// Faces that are new or have other corners than before; ascending.
  const std::set<Face>& changed() const { return changed_; }

 private:
  CornerTexture corner_in(Halfedge inside, Vertex vertex) const;
  void split_side(Halfedge to_middle, double spoke_length, const std::array<Vertex, 2>& ends,
                  const std::array<CornerTexture, 3>& texture, double t);
  void make_part(Face whole, Face part);

  Mesh& mesh_;
  EdgeMap<double> rest_;
  VertexMap<int> line_;
  EdgeMap<bool> line_edge_;
  FaceMap<int> generation_;
  TextureMaps texture_;
  std::optional<FaceMap<int>> group_, material_, lining_;
  EditedAttributes attributes_;
  std::set<Face> changed_;
};

}  // namespace furrow::geometry
