// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <queue>
#include <utility>

#include "geometry/band/band_mesh.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {

/// An edge that is to be split. Lengths are rounded to float, so that rounding does not decide between equal
/// ones: vertices do.
struct WaitingEdge {
  float length;
  Vertex a, b;  // a < b
  bool operator<(const WaitingEdge& other) const {
    if (length != other.length) return length < other.length;
    return std::pair(other.a, other.b) < std::pair(a, b);
  }
};

/// Splits edges of the band, the longest first, while is_too_long(edge) says so; where a side of its two
/// faces is longer than 1.25 of an edge, that side is split first (Rivara's longest edge), so that angles
/// stay bounded. length(edge) [m] in the shape that counts; split(edge) makes the new vertex. Returns how
/// many. O(n log n).
template <class Length, class IsTooLong, class Split>
std::size_t split_longest(const BandMesh& band, const Length& length, const IsTooLong& is_too_long,
                          const Split& split) {
  constexpr double longer_side = 1.25;
  const Mesh& mesh = band.mesh;
  std::priority_queue<WaitingEdge> queue;
  const auto push = [&](Edge e) {
    physics::throw_if_cancelled("wrinkle");
    const Halfedge h = band.from_lower(e);
    if (band.touches_band(e) && is_too_long(e))
      queue.push({static_cast<float>(length(e)), mesh.source(h), mesh.target(h)});
  };
  const auto longest_near = [&](Edge e) {
    while (true) {
      Edge longest = e;
      const Halfedge h = band.from_lower(e);
      for (Halfedge side : {h, mesh.opposite(h)}) {
        if (mesh.is_border(side)) continue;
        for (Halfedge s : {mesh.next(side), mesh.prev(side)})
          if (length(mesh.edge(s)) > longer_side * length(longest)) longest = mesh.edge(s);
      }
      if (longest == e) return e;
      e = longest;
    }
  };
  for (Edge e : mesh.edges()) push(e);
  std::size_t count = 0;
  while (!queue.empty()) {
    const WaitingEdge next = queue.top();
    queue.pop();
    const auto e = band.editor.edge_between(next.a, next.b);
    if (!e || next.length != static_cast<float>(length(*e))) continue;
    const Vertex v = split(longest_near(*e));
    ++count;
    for (Halfedge h : mesh.halfedges_around_target(mesh.halfedge(v))) push(mesh.edge(h));
    if (const auto still = band.editor.edge_between(next.a, next.b)) push(*still);
  }
  return count;
}

}  // namespace furrow::geometry
