// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/render_scene.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"

namespace furrow::io {
namespace {

using geometry::Edge;
using geometry::Face;
using geometry::Halfedge;
using geometry::Mesh;
using geometry::Vertex;

const Colour& colour_of(double height, const LineColours& colours) {
  return height > 0 ? colours.ridge : height < 0 ? colours.valley : colours.other;
}

double squared_length(const Mesh& mesh, Halfedge h) {
  return CGAL::squared_distance(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)));
}

/// The longest side of a triangle whose third corner is on the line, too: it is a shortcut and not a step of
/// the line.
bool is_shortcut(const Mesh& mesh, Halfedge h, const geometry::VertexMap<int>& line) {
  if (mesh.is_border(h) || line[mesh.target(mesh.next(h))] != line[mesh.target(h)]) return false;
  const double length = squared_length(mesh, h);
  return length > squared_length(mesh, mesh.next(h)) && length > squared_length(mesh, mesh.prev(h));
}

std::vector<Edge> line_edges(const Mesh& mesh) {
  const auto marked = geometry::find_map(mesh, geometry::attribute::line_edge);
  const auto line = geometry::find_map(mesh, geometry::attribute::line);
  std::vector<Edge> edges;
  for (Edge e : mesh.edges()) {
    const Halfedge h = mesh.halfedge(e);
    if (marked) {
      if ((*marked)[e]) edges.push_back(e);
    } else if (line && (*line)[mesh.source(h)] >= 0 && (*line)[mesh.source(h)] == (*line)[mesh.target(h)] &&
               !is_shortcut(mesh, h, *line) && !is_shortcut(mesh, mesh.opposite(h), *line)) {
      edges.push_back(e);
    }
  }
  return edges;
}

}  // namespace

RenderMesh render_mesh_from(const Mesh& mesh, Style style, std::shared_ptr<const Image> texture) {
  const auto coordinates = geometry::find_map(mesh, geometry::attribute::texture);
  if (texture && !coordinates)
    throw geometry::ContentError("the mesh has no texture coordinates to lay a texture on with");
  RenderMesh result;
  result.style = style;
  result.texture = std::move(texture);
  result.colour = style == Style::cloth ? cloth_colour : body_colour;
  std::vector<int> index(mesh.num_vertices(), 0);
  const auto colour = geometry::find_map(mesh, geometry::attribute::color);
  bool coloured = false;
  for (Vertex v : mesh.vertices()) {
    index[v] = int(result.vertices.size());
    result.vertices.push_back(position_of(mesh.point(v)));
    if (!colour) continue;
    const auto& c = (*colour)[v];
    coloured = coloured || c[0] < 1 || c[1] < 1 || c[2] < 1;
    result.vertex_colours.push_back({float(c[0]), float(c[1]), float(c[2])});
  }
  if (!coloured) result.vertex_colours.clear();
  for (Face f : mesh.faces()) {
    const Halfedge h = mesh.halfedge(f);
    if (mesh.next(mesh.next(mesh.next(h))) != h) {
      throw geometry::ContentError("face " + std::to_string(std::size_t(f)) +
                                   " is no triangle; triangulate the mesh before it is drawn");
    }
    result.triangles.push_back(
        {index[mesh.source(h)], index[mesh.target(h)], index[mesh.target(mesh.next(h))]});
    if (result.texture)
      result.texture_coordinates.push_back(
          {(*coordinates)[mesh.prev(h)], (*coordinates)[h], (*coordinates)[mesh.next(h)]});
  }
  return result;
}

void mark_faces(RenderMesh& mesh, std::span<const geometry::Index<Face>> faces, const Colour& colour) {
  for (const auto f : faces)
    if (f.idx() >= mesh.triangles.size())
      throw std::invalid_argument("mark_faces: face " + std::to_string(f.idx()) + " of " +
                                  std::to_string(mesh.triangles.size()));
  if (faces.empty()) return;
  if (!mesh.triangle_colours.empty()) {  // which go before all other colours
    for (const auto f : faces) mesh.triangle_colours[f.idx()] = colour;
    return;
  }
  if (mesh.texture)
    for (const auto f : faces)
      mesh.texture_coordinates[f.idx()].fill(
          {NAN, NAN});  // such a triangle shows its colour, not the texture
  if (mesh.vertex_colours.empty()) mesh.vertex_colours.assign(mesh.vertices.size(), mesh.colour);
  for (const auto f : faces)
    for (int& corner : mesh.triangles[f.idx()]) {
      mesh.vertices.push_back(Position(mesh.vertices[std::size_t(corner)]));
      mesh.vertex_colours.push_back(colour);
      corner = int(mesh.vertices.size()) - 1;
    }
}

std::vector<RenderLine> render_lines_from(const Mesh& mesh, const std::vector<double>& heights,
                                          const LineColours& colours) {
  for (std::size_t i = 0; i < heights.size(); ++i) {
    if (std::isnan(heights[i]))
      throw std::invalid_argument("heights: line " + std::to_string(i) + " has NaN");
  }
  const std::vector<Edge> edges = line_edges(mesh);
  std::vector<int> valence(mesh.num_vertices(), 0);
  for (Edge e : edges) {
    ++valence[mesh.vertex(e, 0)];
    ++valence[mesh.vertex(e, 1)];
  }
  const auto line = geometry::find_map(mesh, geometry::attribute::line);
  const auto id_of = [&](Vertex v) { return line ? (*line)[v] : -1; };
  std::vector<RenderLine> result;
  for (Edge e : edges) {
    const Vertex a = mesh.vertex(e, 0), b = mesh.vertex(e, 1);
    int id = std::max(id_of(a), id_of(b));
    if (id_of(a) >= 0 && id_of(b) >= 0 && valence[a] != valence[b])
      id = id_of(valence[a] < valence[b] ? a : b);
    const double height = id >= 0 && std::size_t(id) < heights.size() ? heights[id] : 0;
    result.push_back({{position_of(mesh.point(a)), position_of(mesh.point(b))}, colour_of(height, colours)});
  }
  return result;
}

}  // namespace furrow::io
