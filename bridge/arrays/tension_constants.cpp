// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/arrays/tension_constants.h"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/property_names.h"

namespace furrow::bridge {

std::vector<double> tension_constants(const geometry::Mesh& mesh, double c, double shear) {
  using namespace geometry;
  const auto range = [](const char* name, double value, bool fine) {
    if (!fine)
      throw std::invalid_argument("tension_constants: " + std::string(name) + " = " + std::to_string(value) +
                                  " is out of its range");
  };
  range("tension", c, c > 0 && std::isfinite(c));
  range("shear", shear, shear >= 0 && shear <= 1);
  require_triangles(mesh, "tension_constants");
  const std::vector<double> lengths = rest_lengths(mesh);
  const auto diagonal = find_map(mesh, attribute::diagonal);
  const auto is_diagonal = [&](Halfedge h) { return diagonal && (*diagonal)[mesh.edge(h)]; };
  std::vector<double> constants(lengths.size(), 0.0);
  for (Face f : mesh.faces()) {
    const auto [a, b, d] = edge_lengths(mesh, f, lengths);
    const double area = triangle_area(a, b, d);
    bool woven = false;
    for (Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f))) woven = woven || is_diagonal(h);
    for (Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f))) {
      const double share = !woven ? 2.0 / 3 : is_diagonal(h) ? shear : 1;
      constants[mesh.edge(h).idx()] += c * share * area / lengths[mesh.edge(h).idx()];
    }
  }
  return constants;
}

}  // namespace furrow::bridge
