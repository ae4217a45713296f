// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/render_preview.h"

#include <algorithm>
#include <set>

#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/face_point.h"
#include "geometry/mesh/property_names.h"

namespace furrow::io {
namespace {

/// A quarter of the mean edge, so that dots do not hide the line between them on a fine mesh, and never more
/// than a little above the line. In tubes, which are some 1/600 of a garment that fills the picture.
double dot_width(const geometry::Mesh& mesh, const std::set<geometry::Edge>& edges) {
  constexpr double largest_value = 1.6, least = 0.3, tube = 1.0 / 600;
  if (edges.empty()) return largest_value;
  double sum = 0;
  for (geometry::Edge e : edges) sum += geometry::spatial_length(mesh, e);
  CGAL::Bbox_3 box;
  for (geometry::Vertex v : mesh.vertices()) box += mesh.point(v).bbox();
  const double height = std::max({box.x_span(), box.y_span(), box.z_span()});
  if (!(height > 0)) return largest_value;
  return std::clamp(0.25 * sum / double(edges.size()) / (tube * height), least, largest_value);
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
  for (Edge e : edges) {
    if (marked && (*marked)[e]) continue;
    scene.lines.push_back({{position_of(inserted.point(inserted.vertex(e, 0))),
                            position_of(inserted.point(inserted.vertex(e, 1)))},
                           colours.edge,
                           0.35});
  }
  const double dot = dot_width(inserted, edges);
  for (Vertex v : inserted.vertices())
    if (v.idx() >= old_vertices)
      scene.lines.push_back({{position_of(inserted.point(v))}, colours.vertex, dot});
  return scene;
}

}  // namespace furrow::io
