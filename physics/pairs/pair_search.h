// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/pairs/box_tree.h"
#include "physics/pairs/pair_mesh.h"

namespace furrow::physics {

/// Vertex and triangle, or edge and edge.
struct Candidate {
  int first, second;
};

/// Finds which primitives of a cloth have boxes that meet, by groups of eight triangles that are neighbours,
/// with the edges and vertices that no group before them has: groups are found in a tree of their boxes, then
/// four boxes are compared at a time. Groups are made anew when they have come apart. Neighbours
/// (are_neighbours()) are not told.
class PairSearch {
 public:
  /// The mesh must outlive it.
  explicit PairSearch(const PairMesh& mesh) : mesh_(&mesh) {}

  /// The boxes of all primitives on their way, by their radius and `margin` [m] larger. Cost: some 30 ns a
  /// triangle, five times that where groups are made.
  void place(const FloatSweep& sweep, double margin);
  /// A search among some of the primitives alone, in the groups of this one, with boxes on their way.
  PairSearch among(std::vector<int> edges, std::vector<int> vertices, std::vector<int> triangles,
                   const FloatSweep& sweep, double margin) const;
  int groups() const { return int(fours_of_edges_.size()) - 1; }

  /// Of groups [begin, end) with those from themselves on: edges(candidate), vertices(candidate); over all
  /// groups each pair once.
  template <class Edges, class Vertices>
  void each_pair(int begin, int end, Edges&& edges, Vertices&& vertices) const;
  /// Of all groups with all of another search: edges(own, other's), vertices(own, its triangle) and
  /// triangles(own, its vertex).
  template <class Edges, class Vertices, class Triangles>
  void each_pair_with(const PairSearch& other, Edges&& edges, Vertices&& vertices,
                      Triangles&& triangles) const;

 private:
  /// Primitives with k vertices, in fours.
  template <std::size_t k>
  struct Fours {
    std::vector<FourBoxes> boxes;
    std::vector<Int4> numbers;                  // -1: an empty lane
    std::vector<std::array<Int4, k>> vertices;  // their knots; -1 there, too
    LaneBox box(int i) const { return boxes[std::size_t(i) / 4].lane(std::size_t(i) % 4); }
    int number(int i) const { return numbers[std::size_t(i) / 4][std::size_t(i) % 4]; }
    std::array<int, k> corners(int i) const {
      std::array<int, k> v;
      for (std::size_t j = 0; j < k; ++j) v[j] = vertices[std::size_t(i) / 4][j][std::size_t(i) % 4];
      return v;
    }
  };
  void make_groups(const FloatSweep& sweep);
  void add_group(std::span<const int> triangles, std::span<const int> edges, std::span<const int> vertices);
  void refit(const FloatSweep& sweep, double margin);
  template <std::size_t k>
  void place_fours(const FloatSweep& sweep, const std::vector<double>& radius, double margin,
                   Fours<k>& fours) const;
  std::vector<FourBoxes> group_boxes() const;
  double spread(const FloatSweep& sweep) const;

  /// visit(number) of what meets in at most 16 fours [from, to), without the first lanes of the first of
  /// them.
  template <std::size_t k, std::size_t n, class Visit>
  static void each_of(const Fours<k>& fours, int from, int to, const LaneBox& box,
                      const std::array<int, n>& without, Visit&& visit, int left_out = 0) {
    std::uint64_t met = 0;
    for (int f = from; f < to; ++f) {
      Int4 shared{0, 0, 0, 0};
      for (const Int4& v : fours.vertices[std::size_t(f)])
        for (const int w : without) shared |= v == Int4{w, w, w, w};
      met |= std::uint64_t(bits_of(fours.boxes[std::size_t(f)].meet(box) & ~shared)) << 4 * (f - from);
    }
    for (met &= ~std::uint64_t(0) << left_out; met != 0; met &= met - 1)
      visit(fours.number(4 * from + std::countr_zero(met)));
  }
  /// One group's primitives against another's (or its own, behind each).
  template <std::size_t k, std::size_t n, class Visit>
  static void each_of_groups(const Fours<k>& ones, int begin, int end, const Fours<n>& others, int from,
                             int to, const LaneBox& around, bool same, Visit&& visit) {
    for (int f = begin; f < end; ++f) {
      unsigned near = same ? 15u : bits_of(ones.boxes[std::size_t(f)].meet(around));
      for (; near != 0; near &= near - 1) {
        const int lane = std::countr_zero(near), i = 4 * f + lane, number = ones.number(i);
        each_of(
            others, same ? f : from, to, ones.box(i), ones.corners(i),
            [&](int other) { visit(number, other); }, same ? lane + 1 : 0);
      }
    }
  }

  const PairMesh* mesh_;
  Fours<2> edges_;
  Fours<1> vertices_;
  Fours<3> triangles_;                                               // two fours a group
  std::vector<int> fours_of_edges_ = {0}, fours_of_vertices_ = {0};  // where each group's begin, and the end
  std::vector<int> edge_group_, vertex_group_, triangle_group_;      // of each primitive
  BoxTree tree_;
  double spread_ = -1;  // of the groups when they were made [m]
};

template <class Edges, class Vertices>
void PairSearch::each_pair(int begin, int end, Edges&& edges, Vertices&& vertices) const {
  const auto edge_pair = [&](int a, int b) { edges(Candidate{std::min(a, b), std::max(a, b)}); };
  const auto vertex_pair = [&](int v, int t) { vertices(Candidate{v, t}); };
  for (int g = begin; g < end; ++g) {
    const auto at = std::size_t(g);
    const LaneBox own = tree_.box(g);
    const int e0 = fours_of_edges_[at], e1 = fours_of_edges_[at + 1], v0 = fours_of_vertices_[at],
              v1 = fours_of_vertices_[at + 1];
    tree_.each_meeting(own, g, [&](int other) {
      const auto to = std::size_t(other);
      const LaneBox around = tree_.box(other);
      each_of_groups(edges_, e0, e1, edges_, fours_of_edges_[to], fours_of_edges_[to + 1], around, g == other,
                     edge_pair);
      each_of_groups(vertices_, v0, v1, triangles_, 2 * other, 2 * other + 2, around, false, vertex_pair);
      if (g != other)
        each_of_groups(vertices_, fours_of_vertices_[to], fours_of_vertices_[to + 1], triangles_, 2 * g,
                       2 * g + 2, own, false, vertex_pair);
    });
  }
}

template <class Edges, class Vertices, class Triangles>
void PairSearch::each_pair_with(const PairSearch& other, Edges&& edges, Vertices&& vertices,
                                Triangles&& triangles) const {
  const auto triangle_pair = [&](int its, int own) { triangles(own, its); };
  for (int g = 0; g < groups(); ++g) {
    const auto at = std::size_t(g);
    const LaneBox own = tree_.box(g);
    other.tree_.each_meeting(own, 0, [&](int h) {
      const auto to = std::size_t(h);
      const LaneBox around = other.tree_.box(h);
      each_of_groups(edges_, fours_of_edges_[at], fours_of_edges_[at + 1], other.edges_,
                     other.fours_of_edges_[to], other.fours_of_edges_[to + 1], around, false, edges);
      each_of_groups(vertices_, fours_of_vertices_[at], fours_of_vertices_[at + 1], other.triangles_, 2 * h,
                     2 * h + 2, around, false, vertices);
      each_of_groups(other.vertices_, other.fours_of_vertices_[to], other.fours_of_vertices_[to + 1],
                     triangles_, 2 * g, 2 * g + 2, own, false, triangle_pair);
    });
  }
}

}  // namespace furrow::physics
