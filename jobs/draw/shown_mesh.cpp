// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/draw/shown_mesh.h"

#include <algorithm>
#include <cmath>

#include "geometry/mesh/property_names.h"

namespace furrow::jobs {
namespace {

void add_point(std::vector<float>& list, const geometry::Point& p) {
  for (int k = 0; k < 3; ++k) list.push_back(static_cast<float>(p[k]));
}

/// Whether the texture of its two faces, where both have one, differs at an end of the edge.
bool parts_texture(const geometry::Mesh& mesh,
                   const geometry::HalfedgeMap<geometry::TextureCoordinate>& texture, geometry::Edge e) {
  constexpr double same = 1e-7;
  const geometry::Halfedge h = mesh.halfedge(e), other = mesh.opposite(h);
  const auto differ = [&](geometry::Halfedge a, geometry::Halfedge b) {
    const geometry::TextureCoordinate p = texture[a], q = texture[b];
    return std::abs(p[0] - q[0]) > same || std::abs(p[1] - q[1]) > same;  // not where one is NaN
  };
  return !mesh.is_border(e) && (differ(h, mesh.prev(other)) || differ(mesh.prev(h), other));
}

/// Those of lines and of seams, whose vertices are renumbered by `index`.
void add_edges(ShownMesh& shown, const geometry::Mesh& mesh, const std::vector<std::uint32_t>& index,
               int first_line) {
  const auto line = geometry::find_map(mesh, geometry::attribute::line);
  const auto on_line = geometry::find_map(mesh, geometry::attribute::line_edge);
  const auto texture = geometry::find_map(mesh, geometry::attribute::texture);
  for (const geometry::Edge e : mesh.edges()) {
    const geometry::Vertex a = mesh.vertex(e, 0), b = mesh.vertex(e, 1);
    if (line && on_line && (*on_line)[e]) {
      // A vertex that two lines share belongs to the later one: the edge to the earlier.
      const int owner = (*line)[a] < 0 || (*line)[b] < 0 ? std::max((*line)[a], (*line)[b])
                                                         : std::min((*line)[a], (*line)[b]);
      shown.edges.push_back({index[a], index[b], owner - first_line});
    } else if (texture && parts_texture(mesh, *texture, e)) {
      shown.edges.push_back({index[a], index[b], seam_edge});
    }
  }
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
  add_edges(shown, mesh, index, first_line);
  return shown;
}

}  // namespace furrow::jobs
