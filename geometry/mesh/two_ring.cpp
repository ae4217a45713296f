// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/two_ring.h"

#include <algorithm>
#include <string>

#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/property_names.h"

namespace furrow::geometry {

std::vector<Vertex> vertices_within_rings(const Mesh& mesh, std::span<const Vertex> seeds, int rings) {
  if (rings < 0) refuse("vertices_within_rings", "rings is " + std::to_string(rings));
  require_vertices(mesh, seeds, "vertices_within_rings");
  std::vector<char> seen(mesh.num_vertices(), 0);
  std::vector<Vertex> result;
  const auto add = [&](Vertex v) {
    if (!seen[v.idx()]) result.push_back(v);
    seen[v.idx()] = 1;
  };
  for (Vertex v : seeds) add(v);
  std::size_t first = 0;
  for (int ring = 0; ring < rings; ++ring) {
    const std::size_t last = result.size();
    for (; first < last; ++first) {
      const Vertex v = result[first];
      if (mesh.is_isolated(v)) continue;
      for (Halfedge h : mesh.halfedges_around_target(mesh.halfedge(v))) add(mesh.source(h));
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<Vertex> two_ring(const Mesh& mesh, std::span<const Vertex> seeds) {
  return vertices_within_rings(mesh, seeds, 2);
}

std::vector<Vertex> line_vertices(const Mesh& mesh) {
  std::vector<Vertex> result;
  const auto line = find_map(mesh, attribute::line);
  if (!line) return result;
  for (Vertex v : mesh.vertices())
    if ((*line)[v] >= 0) result.push_back(v);
  return result;
}

}  // namespace furrow::geometry
