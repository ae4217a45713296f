// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/stroke/place_path_stroke.h"

#include "geometry/mesh/degenerate_faces.h"
#include "geometry/stroke/shortest_path.h"

namespace furrow::geometry {
namespace {

Vertex checked(const Mesh& mesh, std::size_t index, std::size_t place, const StrokePlacing& placing) {
  if (index >= mesh.num_vertices() || mesh.is_removed(Vertex(index)))
    placing.refuse(place, "there is no vertex " + std::to_string(index) + "; the garment has " +
                              std::to_string(mesh.number_of_vertices()) + ", counted from 0");
  if (mesh.is_isolated(Vertex(index)))
    placing.refuse(place, "vertex " + std::to_string(index) + " belongs to no face");
  return Vertex(index);
}

}  // namespace

PlacedStroke place_path_stroke(const Mesh& mesh, std::span<const std::size_t> vertices, bool closed,
                               const std::string& stroke_name) {
  StrokePlacing placing(mesh, stroke_name);
  if (vertices.empty()) placing.refuse("has no vertices");
  std::vector<Vertex> stops;
  for (std::size_t i = 0; i < vertices.size(); ++i) stops.push_back(checked(mesh, vertices[i], i, placing));
  if (closed) stops.push_back(stops.front());
  placing.add(mesh.point(stops[0]));
  for (std::size_t i = 1; i < stops.size(); ++i) {
    const std::string names = std::to_string(stops[i - 1].idx()) + " and " + std::to_string(stops[i].idx());
    if (stops[i] == stops[i - 1])
      placing.refuse(i, "vertex " + std::to_string(stops[i].idx()) + " is repeated");
    const auto [path, degenerate] = shortest_path(mesh, stops[i - 1], stops[i]);
    if (degenerate)
      placing.refuse(i, "the way between vertices " + names + " may lead over " +
                            name_with_place(mesh, *degenerate) +
                            ", which is degenerate (it has no area); remove such faces from the garment "
                            "(`furrow info` counts them), or draw this stroke by points");
    if (path.empty()) placing.refuse(i, "no cloth joins vertices " + names);
    for (std::size_t k = 1; k < path.size(); ++k) placing.add(CGAL::midpoint(path[k - 1], path[k]));
    placing.add(path.back());
  }
  return placing.take(closed);
}

}  // namespace furrow::geometry
