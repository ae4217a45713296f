// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/render_preview.h"

#include <algorithm>
#include <set>

#include "geometry/face_point.h"
#include "geometry/property_names.h"

namespace furrow::io {
namespace {

Position position(const geometry::Point& p) { return {p.x(), p.y(), p.z()}; }

}  // namespace

RenderScene preview_scene(const geometry::Mesh& inserted, const std::vector<geometry::Face>& changed,
                          std::size_t old_vertices, const std::vector<double>& heights,
                          const PreviewColours& colours) {
  using namespace geometry;
  RenderScene scene{{render_mesh_from(inserted)}, render_lines_from(inserted, heights, colours.lines)};
  const std::set<Face> selected(changed.begin(), changed.end());
  for (Face f : inserted.faces())
    scene.meshes[0].triangle_colours.push_back(selected.count(f) > 0 ? colours.selected : kClothColour);
  std::set<Edge> edges;
  for (Face f : selected)
    for (Halfedge h : halfedges_of(inserted, f)) edges.insert(inserted.edge(h));
  const auto marked = find_map(inserted, kLineEdge);
  for (Edge e : edges) {
    if (marked && (*marked)[e]) continue;
    scene.lines.push_back(
        {{position(inserted.point(inserted.vertex(e, 0))), position(inserted.point(inserted.vertex(e, 1)))},
         colours.edge,
         0.35});
  }
  for (Vertex v : inserted.vertices())
    if (v.idx() >= old_vertices) scene.lines.push_back({{position(inserted.point(v))}, colours.vertex, 1.6});
  return scene;
}

}  // namespace furrow::io
