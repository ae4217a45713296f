// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/draw/shown_mesh.h"

#include <algorithm>

#include "geometry/mesh/property_names.h"

namespace furrow::jobs {
namespace {

void add_point(std::vector<float>& list, const geometry::Point& p) {
  for (int k = 0; k < 3; ++k) list.push_back(static_cast<float>(p[k]));
}

}  // namespace

ShownMesh shown_mesh(const geometry::Mesh& mesh,
                     std::span<const geometry::Coordinates<geometry::Point>> undrawn, int first_line) {
  ShownMesh shown;
  std::vector<std::uint32_t> index(mesh.num_vertices(), 0);
  std::uint32_t count = 0;
  for (const geometry::Vertex v : mesh.vertices()) {
    index[std::size_t(v)] = count++;
    add_point(shown.positions, mesh.point(v));
    add_point(shown.undrawn,
              std::size_t(v) < undrawn.size() ? geometry::Point(undrawn[std::size_t(v)]) : mesh.point(v));
  }
  for (const geometry::Face f : mesh.faces())
    for (const geometry::Vertex v : mesh.vertices_around_face(mesh.halfedge(f)))
      shown.faces.push_back(index[std::size_t(v)]);
  const auto line = geometry::find_map(mesh, geometry::attribute::line);
  const auto on_line = geometry::find_map(mesh, geometry::attribute::line_edge);
  if (!line || !on_line) return shown;
  for (const geometry::Edge e : mesh.edges()) {
    if (!(*on_line)[e]) continue;
    const geometry::Vertex a = mesh.vertex(e, 0), b = mesh.vertex(e, 1);
    // A vertex that two lines share belongs to the later one: the edge to the earlier.
    const int owner = (*line)[a] < 0 || (*line)[b] < 0 ? std::max((*line)[a], (*line)[b])
                                                       : std::min((*line)[a], (*line)[b]);
    shown.edges.push_back({index[a], index[b], owner - first_line});
  }
  return shown;
}

}  // namespace furrow::jobs
