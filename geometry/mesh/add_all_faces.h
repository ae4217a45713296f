// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace furrow::geometry {

using CornerIndices = std::array<std::size_t, 3>;

/// Whether so many faces meet at a point that add_face(), which walks around it, would be slow.
inline bool has_crowded_point(std::span<const CornerIndices> triangles, std::size_t points) {
  constexpr int crowd = 1000;
  std::vector<int> faces(points, 0);
  for (const CornerIndices& t : triangles)
    for (const std::size_t p : t)
      if (++faces[p] > crowd) return true;
  return false;
}

/// The half-edge from a to b of a CGAL::Surface_mesh; makes the edge where it is missing.
template <class AnyMesh, class Edges>
auto halfedge_between(AnyMesh& mesh, Edges& edges, typename AnyMesh::Vertex_index a,
                      typename AnyMesh::Vertex_index b) {
  const auto key = [](auto from, auto to) { return std::uint64_t{from.idx()} << 32 | to.idx(); };
  if (const auto found = edges.find(key(a, b)); found != edges.end()) return found->second;
  const auto h = mesh.add_edge(a, b);
  edges[key(a, b)] = h;
  edges[key(b, a)] = mesh.opposite(h);
  return h;
}

/// Adds triangles to a CGAL::Surface_mesh that has vertices alone, as add_face() of each would, which it
/// agrees with in all indices, in linear time. False, the mesh of no use then, if an edge has two faces on
/// one side, or a vertex more than one gap.
template <class AnyMesh>
bool add_all_faces(std::span<const CornerIndices> triangles, AnyMesh& mesh) {
  using H = typename AnyMesh::Halfedge_index;
  std::unordered_map<std::uint64_t, H> edges;
  for (const CornerIndices& t : triangles) {
    std::array<H, 3> sides;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto vertex = [&](std::size_t i) {
        return typename AnyMesh::Vertex_index(static_cast<typename AnyMesh::size_type>(t[i % 3]));
      };
      sides[k] = halfedge_between(mesh, edges, vertex(k), vertex(k + 1));
      if (!mesh.is_border(sides[k])) return false;
    }
    const auto face = mesh.add_face();
    mesh.set_halfedge(face, sides[2]);
    for (std::size_t k = 0; k < 3; ++k) {
      mesh.set_face(sides[k], face);
      mesh.set_next(sides[k], sides[(k + 1) % 3]);
      if (!mesh.halfedge(mesh.target(sides[k])).is_valid())
        mesh.set_halfedge(mesh.target(sides[k]), sides[k]);
    }
  }
  std::vector<H> gap(mesh.num_vertices());  // that leaves the vertex
  for (const H h : mesh.halfedges())
    if (mesh.is_border(h) && std::exchange(gap[mesh.source(h)], h).is_valid()) return false;
  for (const H h : gap) {
    if (!h.is_valid()) continue;
    mesh.set_next(h, gap[mesh.target(h)]);
    mesh.set_halfedge(mesh.target(h), h);
  }
  return true;
}

}  // namespace furrow::geometry
