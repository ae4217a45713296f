// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "geometry/mesh/mesh.h"
#include "geometry/refine/quarters.h"

/// A mesh that is refined where it is asked to be, and nowhere else.
namespace furrow::geometry {

/// Where a vertex of a mesh that was refined locally would be in the mesh that loop_subdivide() makes of the
/// whole: its index there. Such a mesh has this map; it is no attribute, no file has it, and what changes the
/// mesh leaves it behind.
std::optional<VertexMap<int>> uniform_indices(const Mesh& mesh);
void drop_uniform_indices(Mesh& mesh);

/// The values of a uniform mesh, one a vertex, for the vertices that a mesh has of it. A mesh without
/// uniform_indices() has all of them.
template <class T>
std::vector<T> take_of_uniform(const Mesh& mesh, const std::vector<T>& uniform) {
  const auto index = uniform_indices(mesh);
  if (!index) return uniform;
  std::vector<T> taken;
  taken.reserve(mesh.number_of_vertices());
  for (const Vertex v : mesh.vertices()) taken.push_back(uniform[std::size_t((*index)[v])]);
  return taken;
}

/// A triangle mesh, faces of which have been cut into four again and again, as loop_subdivide() does, down to
/// some depth. Two faces beside each other differ by one cut at most. Where they do, the larger one is cut
/// into two or three parts for the time being, so that the mesh has no open seams.
/// \details "Red" and "green" faces: R. E. Bank, A. H. Sherman, A. Weiser, "Refinement algorithms and data
/// structures for regular local mesh refinement" (1983). The finest uniform mesh is made once: all vertices
/// lie on its surface, whatever is refined, and have its attributes.
class LocalRefinement {
 public:
  /// depth: how often a face may be cut; in [0, 6]. Throws as loop_subdivide(). Cost: that of
  /// loop_subdivide().
  LocalRefinement(const Mesh& mesh, int depth);

  /// The mesh as it is refined now. Old vertices keep their index; rest lengths and attributes are as
  /// loop_subdivide() would leave them, and in a face cut for the time being as in the flat triangle that it
  /// is at rest. Struts are dropped. O(vertices).
  Mesh mesh() const { return mesh(depth()); }
  /// The same with its vertices where they are after so many steps of Loop's scheme, in [0, depth], as many
  /// as the most that a face of it was cut at least.
  Mesh mesh(int steps) const;

  /// Cuts the faces of mesh() that are named, where they may be cut, and those that have to follow. Returns
  /// how many faces were cut: 0: mesh() is as before.
  std::size_t refine(std::span<const Face> faces);

  /// How often the face of the garment was cut to which a face of mesh() belongs, parts for the time being
  /// apart; in [0, depth].
  int cuts(Face face) const { return leaves_[source_[face.idx()].leaf].level; }
  /// The uniform mesh after so many steps.
  const Mesh& uniform(int steps) const { return on(steps); }
  int depth() const { return int(levels_.size()) - 1; }
  /// Vertices of the mesh that is cut everywhere.
  std::size_t uniform_vertices() const { return levels_.back().number_of_vertices(); }
  /// The ends of the edge that a vertex of the uniform mesh is the middle of, by their indices there; an old
  /// vertex is its own.
  std::array<std::size_t, 2> ends_of(std::size_t uniform) const;

 private:
  using Triangle = std::array<std::size_t, 3>;  ///< vertices of the uniform mesh
  struct Leaf {
    int level;
    Face face;  ///< of its level
    Face old;   ///< of the mesh given
  };
  struct Part {
    std::size_t leaf;
    Triangle corners;
  };

  bool is_red(int level, Face f) const { return red_[std::size_t(level)][f.idx()] != 0; }
  bool is_cut(int level, Edge e) const;
  void cut(int level, Face f, std::size_t& count);
  std::size_t middle(int level, Edge e) const { return middle_of(on(level), e).idx(); }
  const Mesh& on(int level) const { return levels_[std::size_t(level)]; }
  void visit(int level, Face f, Face old);
  void close(std::size_t leaf);
  void close_two(std::size_t leaf, const Triangle& corners, std::size_t m, std::size_t n);
  void list_parts();
  Mesh connect(const Mesh& places) const;
  std::array<double, 3> weights_in(Face old, std::size_t uniform) const;
  std::optional<std::pair<int, Halfedge>> find(int leaf_level, std::size_t a, std::size_t b) const;
  template <class Length>
  double median(const Leaf& leaf, std::size_t a, std::size_t b, const Length& length) const;
  void take_edges(Mesh& mesh) const;

  std::vector<Mesh> levels_;
  std::vector<std::vector<char>> red_;  ///< by level, all but the last; by face: whether it is cut
  std::vector<Leaf> leaves_;            ///< faces that are not cut
  std::vector<Part> source_;            ///< by face of mesh()
};

}  // namespace furrow::geometry
