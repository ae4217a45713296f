// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/line_region.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <string>

#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/two_ring.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {

std::vector<double> lengths_before_lines(const Mesh& mesh) {
  std::vector<double> lengths = rest_lengths(mesh);
  const auto rest = find_map(mesh, attribute::rest_position);
  if (!rest) return lengths;
  for (Edge e : mesh.edges()) {
    const RestPosition &a = (*rest)[mesh.vertex(e, 0)], &b = (*rest)[mesh.vertex(e, 1)];
    const double length = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    if (std::isfinite(length)) lengths[e.idx()] = length;
  }
  return lengths;
}

std::vector<Vertex> vertices_within(const Mesh& mesh, std::span<const Vertex> seeds, double reach,
                                    const std::vector<double>& length_of_edge) {
  if (!(reach >= 0)) refuse("vertices_within", "reach is " + std::to_string(reach));
  require_vertices(mesh, seeds, "vertices_within");
  std::vector<double> distance(mesh.num_vertices(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, Vertex>;  // ties by index
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> next;
  const auto offer = [&](Vertex v, double d) {
    if (!(d < distance[v.idx()]) || d > reach) return;
    distance[v.idx()] = d;
    next.emplace(d, v);
  };
  for (Vertex v : seeds) offer(v, 0);
  std::vector<Vertex> result;
  while (!next.empty()) {
    physics::throw_if_cancelled("wrinkle");
    const auto [d, v] = next.top();
    next.pop();
    if (d > distance[v.idx()]) continue;
    result.push_back(v);
    if (mesh.is_isolated(v)) continue;
    for (Halfedge h : mesh.halfedges_around_target(mesh.halfedge(v)))
      offer(mesh.source(h), d + length_of_edge[mesh.edge(h).idx()]);
  }
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<Vertex> line_region(const Mesh& mesh, std::span<const Vertex> line, double width,
                                const std::vector<double>& length_of_edge) {
  const std::vector<Vertex> least = two_ring(mesh, line);
  if (!(width > 0)) return least;
  const std::vector<Vertex> wide = vertices_within(mesh, line, largest_detour * width / 2, length_of_edge);
  std::vector<Vertex> both;
  std::set_union(least.begin(), least.end(), wide.begin(), wide.end(), std::back_inserter(both));
  return both;
}

}  // namespace furrow::geometry
