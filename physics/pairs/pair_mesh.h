// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/cloth/cloth.h"

namespace furrow::physics {

/// What of a cloth can touch: its triangles, their edges and vertices, and how thick it is there.
struct PairMesh {
  std::vector<std::array<int, 3>> triangles;       ///< as the cloth's
  std::vector<std::array<int, 2>> edges;           ///< of the triangles, (a, b) with a < b, sorted, each once
  std::vector<std::array<int, 3>> triangle_edges;  ///< numbers; edge i begins at a triangle's corner i
  std::vector<double> rest_lengths;                ///< of the edges [m]; > 0 unless two vertices coincide
  /// Half of the cloth's thickness, of each vertex: a quarter of the least rest altitude of its triangles at
  /// most, so that flat cloth at rest does not touch itself; of edges and triangles the least of their
  /// vertices [m].
  std::vector<double> radius, edge_radius, triangle_radius;
  std::vector<char> held;                 ///< by vertex: it does not move
  std::vector<char> used;                 ///< by vertex: a triangle has it
  std::vector<int> around, around_begin;  ///< triangles around vertices, and where each vertex's begin
  /// By vertex: the lowest that springs of no length, 1e-9 m or less, join it with; what has one of these has
  /// all, so that the two sides of a tied seam are neighbours.
  std::vector<int> knot;
  std::vector<int> group;     ///< by vertex: two groups do not touch; empty: all is one
  double mean_edge = 0;       ///< h [m]
  double largest_radius = 0;  ///< [m]
};

/// Whether a mesh lets what has one vertex touch what has the other.
inline bool may_touch(const PairMesh& mesh, int a, int b) {
  return mesh.group.empty() || mesh.group[std::size_t(a)] == mesh.group[std::size_t(b)];
}

/// Whether one of the two has a vertex of the other.
template <std::size_t k, std::size_t n>
bool are_neighbours(const PairMesh& mesh, const std::array<int, k>& a, const std::array<int, n>& b) {
  for (const int v : a)
    for (const int w : b)
      if (mesh.knot[std::size_t(v)] == mesh.knot[std::size_t(w)]) return true;
  return false;
}

/// Lengths at rest are those of the membrane's triangles, else of structural springs, else of tension, else
/// as the cloth lies. thickness > 0 [m]; thicknesses: of each particle, in its place, or empty. Throws
/// std::invalid_argument otherwise, or if a triangle names a particle that is not there. Cost: O(n log n).
PairMesh pair_mesh(const Cloth& cloth, double thickness, std::span<const double> thicknesses = {});

/// Vertex against triangle, or edge against edge, by their numbers; in the order of sums: vertices first.
struct PairKey {
  std::uint8_t edges;  ///< 1: edge `first` against edge `second`, first < second
  int first, second;
  auto operator<=>(const PairKey&) const = default;
};
/// Its vertices as PairDistance has them.
inline std::array<int, 4> vertices_of(const PairMesh& mesh, const PairKey& key) {
  if (key.edges) {
    const auto &a = mesh.edges[std::size_t(key.first)], &b = mesh.edges[std::size_t(key.second)];
    return {a[0], a[1], b[0], b[1]};
  }
  const auto& t = mesh.triangles[std::size_t(key.second)];
  return {key.first, t[0], t[1], t[2]};
}
/// The distance from which on the two do not touch [m].
inline double range_of(const PairMesh& mesh, const PairKey& key) {
  return key.edges ? mesh.edge_radius[std::size_t(key.first)] + mesh.edge_radius[std::size_t(key.second)]
                   : mesh.radius[std::size_t(key.first)] + mesh.triangle_radius[std::size_t(key.second)];
}

}  // namespace furrow::physics
