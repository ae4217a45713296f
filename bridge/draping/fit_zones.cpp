// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/draping/fit_zones.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "geometry/mesh/mesh.h"

namespace furrow::bridge {
namespace {

using geometry::Face;
using geometry::Mesh;
using geometry::Vector;
using geometry::Vertex;

FitZone zone_of(const Mesh& mesh, const std::vector<Face>& faces, const std::vector<double>& peaks) {
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
    zone.peak = std::max(zone.peak, peaks[f.idx()]);
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
  std::vector<char> over(mesh.num_faces(), 0);
  std::vector<double> peaks(mesh.num_faces(), -std::numeric_limits<double>::infinity());
  for (Face f : mesh.faces()) {
    double sum = 0;
    for (Vertex v : mesh.vertices_around_face(mesh.halfedge(f))) {
      sum += values[v.idx()];
      peaks[f.idx()] = std::max(peaks[f.idx()], values[v.idx()]);
    }
    over[f.idx()] = sum / 3 > threshold;
  }
  return fit_zones(mesh, std::move(over), peaks, smallest);
}

FitZones fit_zones(const Mesh& mesh, std::vector<char> chosen, const std::vector<double>& peaks,
                   double smallest) {
  if (chosen.size() < mesh.num_faces() || peaks.size() < mesh.num_faces())
    throw std::invalid_argument("fit_zones: " + std::to_string(std::min(chosen.size(), peaks.size())) +
                                " values for " + std::to_string(mesh.num_faces()) + " faces");
  FitZones result;
  for (Face seed : mesh.faces()) {
    if (!chosen[seed.idx()]) continue;
    std::vector<Face> faces{seed};
    chosen[seed.idx()] = 0;
    for (std::size_t i = 0; i < faces.size(); ++i)
      for (Face g : mesh.faces_around_face(mesh.halfedge(faces[i])))
        if (g.is_valid() && chosen[g.idx()]) {
          chosen[g.idx()] = 0;
          faces.push_back(g);
        }
    FitZone zone = zone_of(mesh, faces, peaks);
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
