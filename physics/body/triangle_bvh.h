// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/base/arrays.h"
#include "physics/base/float4.h"
#include "physics/body/closest_on_triangle.h"
#include "physics/body/corner_cones.h"
#include "physics/body/exact_distance.h"
#include "physics/body/oriented_boxes.h"

namespace furrow::physics {

/// Tree of boxes over triangles, four children a node and four triangles a leaf, for exact closest points.
/// Boxes and leaves are searched in float with a bound on its rounding; the triangles that can be closest are
/// then computed in double. The order of the search depends on nothing but the input. Source: method S1.9.
class TriangleBvh {
 public:
  static constexpr int leaf_size = 4;
  static constexpr float far_away = 1e15f;  ///< where empty lanes lie [m]; its square is a finite float

  /// Four boxes; child >= 0 is a node, child < 0 the leaf ~child, `none` no child (its box is far away).
  struct Node {
    static constexpr int none = -2147483647 - 1;
    Float4 middle[3], half[3];  ///< centre relative to centre() and half the edges [m]
    std::array<int, 4> child;
  };
  /// Four triangles: corner a, edges e1 = b - a and e2 = c - a, unit normal, the edges' products and
  /// inverses, and det = g11 g22 - g12^2, negative for a triangle without area: its plane says nothing.
  struct Leaf {
    Float4 a[3], e1[3], e2[3], n[3];
    Float4 g11, g12, g22, det, inverse11, inverse22, inverse33;
    std::array<int, 4> triangle;  ///< `none` where a leaf is not full
  };

  /// Needs check_body(mesh). Cost O(T log T), 100,000 triangles: about 0.06 s.
  explicit TriangleBvh(const TriangleMesh& mesh);

  /// The same triangles with their vertices elsewhere, none dropped: boxes are fitted anew, what lies in
  /// which box stays. Needs check_body(mesh). Cost O(T), a tenth of a new tree.
  void move(const TriangleMesh& mesh);
  /// Surface of all boxes over that of the one around them [-]: how much a search has to look at. It grows
  /// where triangles of a box have moved apart.
  double surface_of_boxes() const;

  /// Leaves the triangles with dropped[t] != 0 out of closest(). At least one must stay
  /// (std::invalid_argument).
  void drop(std::span<const char> dropped);

  /// Exact closest point (up to double rounding) over the triangles that are not dropped.
  ClosestPoint closest(const Vec3& x) const { return closest(x, first_kept_); }
  /// The same; a triangle near x as first guess makes it faster (and is the answer beyond 1e12 m and for
  /// NaN). Adds the leaves that it looked at to `searched`.
  ClosestPoint closest(const Vec3& x, int guess, std::int64_t* searched = nullptr) const;

  /// Appends the triangles whose leaf's box meets the box [low, high]: unsorted, some farther, no kept one
  /// missing.
  void append_near(const Vec3& low, const Vec3& high, std::vector<int>& triangles) const;

  std::span<const Node> nodes() const { return nodes_; }  ///< the root first, parents before children
  std::span<const Leaf> leaves() const { return leaves_; }
  const std::array<Vec3, 3>& corners(int triangle) const { return corners_[slot_of_[triangle]]; }  ///< [m]
  const Vec3& centre() const { return centre_; }
  double radius() const { return radius_; }  ///< largest coordinate relative to centre() [m]
  /// Whether many triangles are needles, so that nodes have boxes along them besides.
  bool has_oriented_boxes() const { return !oriented_.empty(); }
  /// Whether a thousand triangles or more meet at a place, so that nodes have cones from there besides.
  bool has_corner_cones() const { return !cones_.empty(); }

 private:
  int build(const std::vector<Vec3>& centroids, const TriangleMesh& mesh, std::vector<int>& order, int begin,
            int end);
  int add_leaf(const TriangleMesh& mesh, const std::vector<int>& order, int begin, int end);
  void surround(const TriangleMesh& mesh);
  bool is_kept(int triangle) const {
    const int slot = slot_of_[triangle];
    return leaves_[slot / leaf_size].a[0][slot % leaf_size] < far_away;
  }
  void set_lane(int leaf, int lane, bool used);
  void refit(std::span<const char> dropped);
  bool has_needles() const;
  void orient(std::span<const char> dropped);
  void fit_cones(std::span<const char> dropped);
  struct Search;
  void search(Search& search) const;
  void push_children(Search& search, const Node& node) const;
  Float4 apart_by_cones(Search& search, const CornerCones& cones) const;
  void search_leaf(Search& search, int leaf) const;
  void settle(Search& search) const;

  Vec3 centre_;
  double radius_;  ///< largest coordinate relative to centre_ [m]
  int first_kept_ = 0;
  std::vector<Node> nodes_;
  std::vector<OrientedBoxes> oriented_;  ///< of the nodes' children; empty unless there are many needles
  CrowdedCorners crowded_;
  std::vector<CornerCones> cones_;  ///< likewise; empty unless a crowd of triangles shares a corner
  std::vector<Leaf> leaves_;
  std::vector<std::array<Vec3, 3>> corners_;  ///< in the order of the leaves, 4 a leaf
  std::vector<int> slot_of_;
};

}  // namespace furrow::physics
