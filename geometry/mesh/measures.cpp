// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "geometry/mesh/border_loops.h"
#include "geometry/mesh/degenerate_faces.h"
#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/parts.h"
#include "geometry/mesh/preconditions.h"

namespace furrow::geometry {
namespace {

/// Whether all halfedges that end at a vertex are one fan: at most one gap, and reached by one turn around
/// it.
bool is_manifold(const Mesh& mesh) {
  std::vector<std::size_t> ending(mesh.num_vertices(), 0), gaps(mesh.num_vertices(), 0);
  for (Halfedge h : mesh.halfedges()) {
    ++ending[mesh.target(h).idx()];
    gaps[mesh.target(h).idx()] += mesh.is_border(h);
  }
  return std::all_of(mesh.vertices().begin(), mesh.vertices().end(), [&](Vertex v) {
    if (mesh.is_isolated(v)) return true;
    return gaps[v.idx()] <= 1 && ending[v.idx()] == mesh.degree(v);
  });
}

void add_face(const Mesh& mesh, Face f, MeshInfo& info, double& volume) {
  std::array<Point, 3> p;
  std::size_t n = 0;
  for (Vertex v : mesh.vertices_around_face(mesh.halfedge(f))) p[n++] = mesh.point(v);
  const Vector u = p[1] - p[0], w = p[2] - p[0];
  const double doubled = std::sqrt(CGAL::cross_product(u, w).squared_length());
  double longest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector a = p[(i + 1) % 3] - p[i], b = p[(i + 2) % 3] - p[i];
    longest = std::max(longest, a.squared_length());
    const double angle = std::atan2(doubled, a * b) * 180 / std::numbers::pi;
    info.min_angle_deg = std::min(info.min_angle_deg, angle);
  }
  info.degenerate_faces += is_degenerate(doubled, longest);
  info.area += 0.5 * doubled;
  // From a corner of the box, so that a body far from the origin loses no digits.
  volume += CGAL::determinant(p[0] - info.box_min, p[1] - info.box_min, p[2] - info.box_min) / 6;
}

void measure_box(const Mesh& mesh, MeshInfo& info) {
  if (info.vertices == 0) return;
  CGAL::Bbox_3 box;
  for (Vertex v : mesh.vertices()) box += mesh.point(v).bbox();
  info.box_min = Point(box.xmin(), box.ymin(), box.zmin());
  info.box_max = Point(box.xmax(), box.ymax(), box.zmax());
}

}  // namespace

MeshInfo measure(const Mesh& mesh) {
  require_finite(mesh, "measure");
  require_triangles(mesh, "measure");
  MeshInfo info;
  info.vertices = mesh.number_of_vertices();
  info.edges = mesh.number_of_edges();
  info.faces = mesh.number_of_faces();
  for (Vertex v : mesh.vertices()) info.isolated_vertices += mesh.is_isolated(v);
  info.components = find_parts(mesh).list.size();
  info.boundary_loops = border_loops(mesh).size();
  info.euler_characteristic =
      static_cast<long>(info.vertices - info.isolated_vertices + info.faces) - static_cast<long>(info.edges);
  info.closed = info.faces > 0 && info.boundary_loops == 0;
  info.manifold = is_manifold(mesh);
  measure_box(mesh, info);
  info.min_angle_deg = info.faces > 0 ? 180 : 0;
  double volume = 0;
  for (Face f : mesh.faces()) add_face(mesh, f, info, volume);
  if (info.closed) info.volume = volume;
  for (Edge e : mesh.edges()) info.mean_edge_length += spatial_length(mesh, e);
  if (info.edges > 0) info.mean_edge_length /= static_cast<double>(info.edges);
  return info;
}

std::string length_text(double metres) {
  const double size = std::abs(metres);
  if (size == 0) return "0 mm";
  char text[64];
  if (!(size >= 1e-6 && size < 1e6)) {
    std::snprintf(text, sizeof text, "%.3g m", metres);
    return text;
  }
  const bool small = size < 0.9995;  // what rounds to 1000 mm is a metre
  const double value = small ? 1000 * metres : metres;
  const int decimals = std::max(0, 2 - static_cast<int>(std::floor(std::log10(std::abs(value)))));
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  std::string number = text;
  if (number.find('.') != std::string::npos) {
    number.erase(number.find_last_not_of('0') + 1);
    if (number.back() == '.') number.pop_back();
  }
  return number + (small ? " mm" : " m");
}

}  // namespace furrow::geometry
