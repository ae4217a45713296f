// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/insert/restore_delaunay.h"

#include <deque>
#include <set>

#include "geometry/insert/flip_rules.h"

namespace furrow::geometry {

std::size_t restore_delaunay(MeshEditor& editor, const InsertionOptions& options) {
  constexpr double tie = 1e-7;  // four points on a circle: either diagonal is Delaunay
  const Mesh& mesh = editor.mesh();
  std::set<Face> region = editor.changed();
  for (Face face : editor.changed()) {
    for (Halfedge h : halfedges_of(mesh, face)) {
      if (!mesh.is_border(mesh.opposite(h))) region.insert(mesh.face(mesh.opposite(h)));
    }
  }
  std::set<Edge> waiting;
  std::deque<Edge> queue;
  const auto enqueue = [&](Edge e) {
    const bool inner = !mesh.is_border(e) && region.count(mesh.face(mesh.halfedge(e, 0))) > 0 &&
                       region.count(mesh.face(mesh.halfedge(e, 1))) > 0;
    if (inner && waiting.insert(e).second) queue.push_back(e);
  };
  for (Face face : region) {
    for (Halfedge h : halfedges_of(mesh, face)) enqueue(mesh.edge(h));
  }
  std::size_t flips = 0;
  // Flips end in exact arithmetic; the limit guards against rounding.
  const std::size_t limit = 100 * queue.size();
  while (!queue.empty() && flips < limit) {
    const Edge e = queue.front();
    queue.pop_front();
    waiting.erase(e);
    if (!(cotangent_sum(mesh, editor.rest(), e) < -tie) || refusal_of_flip(editor, e, options)) continue;
    editor.flip_edge(e);
    ++flips;
    for (int side = 0; side < 2; ++side) {
      for (Halfedge h : halfedges_of(mesh, mesh.face(mesh.halfedge(e, side)))) enqueue(mesh.edge(h));
    }
  }
  return flips;
}

}  // namespace furrow::geometry
