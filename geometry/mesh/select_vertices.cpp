// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/select_vertices.h"

#include <algorithm>

#include "geometry/mesh/property_names.h"

namespace furrow::geometry {

std::vector<Vertex> vertices_in_box(const Mesh& mesh, const Point& low, const Point& high) {
  std::vector<Vertex> inside;
  for (Vertex v : mesh.vertices()) {
    bool in = true;
    for (int k = 0; k < 3; ++k)
      in = in && mesh.point(v)[k] >= std::min(low[k], high[k]) &&
           mesh.point(v)[k] <= std::max(low[k], high[k]);
    if (in) inside.push_back(v);
  }
  return inside;
}

std::vector<Vertex> vertices_of_group(const Mesh& mesh, int group) {
  const auto groups = find_map(mesh, attribute::group);
  std::vector<Vertex> vertices;
  if (!groups) return vertices;
  for (Face f : mesh.faces()) {
    if ((*groups)[f] != group) continue;
    for (Vertex v : mesh.vertices_around_face(mesh.halfedge(f))) vertices.push_back(v);
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

}  // namespace furrow::geometry
