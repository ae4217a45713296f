// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/render_preview.h"

#include <algorithm>
#include <set>

#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/face_point.h"
#include "geometry/mesh/property_names.h"

namespace furrow::io {
namespace {

/// The mean length of edges, in tubes, which are some 1/600 of a garment that fills the picture; 0: none.
double mean_in_tubes(const geometry::Mesh& mesh, const std::set<geometry::Edge>& edges) {
  constexpr double tube = 1.0 / 600;
  double sum = 0;
  for (geometry::Edge e : edges) sum += geometry::spatial_length(mesh, e);
  CGAL::Bbox_3 box;
  for (geometry::Vertex v : mesh.vertices()) box += mesh.point(v).bbox();
  const double height = std::max({box.x_span(), box.y_span(), box.z_span()});
  return height > 0 && !edges.empty() ? sum / double(edges.size()) / (tube * height) : 0;
}

}  // namespace

RenderScene preview_scene(const geometry::Mesh& inserted,
                          const std::vector<geometry::Index<geometry::Face>>& changed,
                          std::size_t old_vertices, const std::vector<double>& heights,
                          const PreviewColours& colours) {
  using namespace geometry;
  RenderScene scene{{render_mesh_from(inserted)}, render_lines_from(inserted, heights, colours.lines)};
  const std::set<Face> selected(changed.begin(), changed.end());
  for (Face f : inserted.faces())
    scene.meshes[0].triangle_colours.push_back(selected.count(f) > 0 ? colours.selected : cloth_colour);
  std::set<Edge> edges;
  for (Face f : selected)
    for (Halfedge h : halfedges_of(inserted, f)) edges.insert(inserted.edge(h));
  const auto marked = find_map(inserted, attribute::line_edge);
  // By the mean edge, so that what is pointed out stays to be seen between edges and dots on a fine mesh.
  // Edges of less than thinnest_edge would be grey haze.
  constexpr double widest_edge = 0.35, thinnest_edge = 0.08, least_dot = 0.3, largest_dot = 1.6;
  const double mean = mean_in_tubes(inserted, edges), width = std::min(widest_edge, 0.03 * mean),
               dot = std::clamp(0.15 * mean, least_dot, largest_dot);
  for (Edge e : edges) {
    if (width < thinnest_edge || (marked && (*marked)[e])) continue;
    scene.lines.push_back({{position_of(inserted.point(inserted.vertex(e, 0))),
                            position_of(inserted.point(inserted.vertex(e, 1)))},
                           colours.edge,
                           width});
  }
  for (Vertex v : inserted.vertices())
    if (v.idx() >= old_vertices)
      scene.lines.push_back({{position_of(inserted.point(v))}, colours.vertex, dot});
  return scene;
}

}  // namespace furrow::io
