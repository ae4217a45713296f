// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/rest/masses.h"

#include <cmath>
#include <string>

#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/property_names.h"

namespace furrow::geometry {

double lump_masses(Mesh& mesh, double density) {
  if (!(density > 0) || !std::isfinite(density))
    refuse("lump_masses", "density is " + std::to_string(density) + " kg/m^2; it must be finite and > 0");
  require_triangles(mesh, "lump_masses");
  const std::vector<double> lengths = rest_lengths(mesh);
  auto mass = ensure_map(mesh, attribute::mass);
  for (Vertex v : mesh.vertices()) mass[v] = 0;
  double total = 0;
  for (Face f : mesh.faces()) {
    const auto [a, b, c] = edge_lengths(mesh, f, lengths);
    const double m = density * triangle_area(a, b, c);
    total += m;
    for (Vertex v : mesh.vertices_around_face(mesh.halfedge(f))) mass[v] += m / 3;
  }
  return total;
}

}  // namespace furrow::geometry
