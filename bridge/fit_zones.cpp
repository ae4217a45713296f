// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/fit_zones.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace furrow::bridge {
namespace {

using geometry::Face;
using geometry::Mesh;
using geometry::Vector;
using geometry::Vertex;

bool is_over(const Mesh& mesh, Face f, const std::vector<double>& values, double threshold) {
  double sum = 0;
  for (Vertex v : mesh.vertices_around_face(mesh.halfedge(f))) sum += values[v.idx()];
  return sum / 3 > threshold;
}

FitZone zone_of(const Mesh& mesh, const std::vector<Face>& faces, const std::vector<double>& values) {
  FitZone zone;
  zone.peak = -std::numeric_limits<double>::infinity();
  Vector weighted(0, 0, 0);
  for (Face f : faces) {
    std::array<Vertex, 3> v;
    std::size_t n = 0;
    for (Vertex corner : mesh.vertices_around_face(mesh.halfedge(f))) v[n++] = corner;
    const Vector a = mesh.point(v[0]) - CGAL::ORIGIN, b = mesh.point(v[1]) - CGAL::ORIGIN,
                 c = mesh.point(v[2]) - CGAL::ORIGIN;
    const double area = std::sqrt(CGAL::cross_product(b - a, c - a).squared_length()) / 2;
    zone.area += area;
    weighted += area / 3 * (a + b + c);
    for (Vertex corner : v) zone.peak = std::max(zone.peak, values[corner.idx()]);
  }
  zone.centre = zone.area > 0 ? CGAL::ORIGIN + weighted / zone.area
                              : mesh.point(mesh.target(mesh.halfedge(faces.front())));
  return zone;
}

}  // namespace

FitZones fit_zones(const Mesh& mesh, const std::vector<double>& values, double threshold, double smallest) {
  if (values.size() < mesh.num_vertices())
    throw std::invalid_argument("fit_zones: " + std::to_string(values.size()) + " values for " +
                                std::to_string(mesh.num_vertices()) + " vertices");
  FitZones result;
  std::vector<char> open(mesh.num_faces(), 0);
  for (Face f : mesh.faces()) open[f.idx()] = is_over(mesh, f, values, threshold);
  for (Face seed : mesh.faces()) {
    if (!open[seed.idx()]) continue;
    std::vector<Face> faces{seed};
    open[seed.idx()] = 0;
    for (std::size_t i = 0; i < faces.size(); ++i)
      for (Face g : mesh.faces_around_face(mesh.halfedge(faces[i])))
        if (g.is_valid() && open[g.idx()]) {
          open[g.idx()] = 0;
          faces.push_back(g);
        }
    FitZone zone = zone_of(mesh, faces, values);
    if (zone.area >= smallest)
      result.zones.push_back(std::move(zone));
    else
      ++result.left_out;
  }
  std::stable_sort(result.zones.begin(), result.zones.end(),
                   [](const FitZone& a, const FitZone& b) { return a.area > b.area; });
  return result;
}

}  // namespace furrow::bridge
