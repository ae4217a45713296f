// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <numbers>
#include <vector>

#include "geometry/mesh/preconditions.h"
#include "geometry/rest/rest_metric.h"
#include "geometry/rest/rest_state.h"

namespace furrow::geometry {

RestMetricAudit audit_rest_metric(const Mesh& mesh) {
  check_mesh(mesh, "audit_rest_metric");
  RestMetricAudit audit;
  const auto rest = find_map(mesh, attribute::rest_length);
  const auto length = [&](Halfedge h) {
    const double set = rest ? (*rest)[mesh.edge(h)] : unset_value;
    return set == set
               ? set
               : std::sqrt(CGAL::squared_distance(mesh.point(mesh.source(h)), mesh.point(mesh.target(h))));
  };
  double least = std::numbers::pi / 3;
  for (Face f : mesh.faces()) {
    const auto h = halfedges_of(mesh, f);
    const TriangleLengths lengths{length(h[0]), length(h[1]), length(h[2])};
    const bool proper = is_proper_triangle(lengths);
    audit.inverted_faces += !proper;
    least = std::min(least, proper ? smallest_angle(lengths) : 0.0);
    if (proper) audit.area += triangle_area(lengths);
  }
  audit.min_angle_deg = least * 180 / std::numbers::pi;
  std::vector<std::pair<Vertex, Vertex>> ends;
  for (Edge e : mesh.edges()) ends.push_back(std::minmax(mesh.vertex(e, 0), mesh.vertex(e, 1)));
  std::sort(ends.begin(), ends.end());
  for (std::size_t i = 1; i < ends.size(); ++i) audit.duplicate_edges += ends[i] == ends[i - 1];
  return audit;
}

}  // namespace furrow::geometry
