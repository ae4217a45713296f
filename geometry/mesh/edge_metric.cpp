// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/edge_metric.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"

namespace furrow::geometry {

double spatial_length(const Mesh& mesh, Edge e) {
  return std::sqrt(CGAL::squared_distance(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));
}

std::vector<double> rest_lengths(const Mesh& mesh) {
  std::vector<double> lengths(mesh.num_edges(), 0);
  const auto rest = find_map(mesh, attribute::rest_length);
  for (Edge e : mesh.edges()) {
    const double set = rest ? (*rest)[e] : unset_value;
    lengths[e.idx()] = std::isnan(set) ? spatial_length(mesh, e) : set;
    if (lengths[e.idx()] >= 0 && std::isfinite(lengths[e.idx()])) continue;
    throw ContentError("edge " + std::to_string(mesh.vertex(e, 0).idx()) + "-" +
                       std::to_string(mesh.vertex(e, 1).idx()) + " has the rest length " +
                       std::to_string(lengths[e.idx()]) + "; it must be finite and >= 0");
  }
  return lengths;
}

std::array<double, 3> edge_lengths(const Mesh& mesh, Face f, const std::vector<double>& length_of_edge) {
  const Halfedge h = mesh.halfedge(f), n = mesh.next(h), p = mesh.prev(h);
  return {length_of_edge[mesh.edge(h).idx()], length_of_edge[mesh.edge(n).idx()],
          length_of_edge[mesh.edge(p).idx()]};
}

double triangle_area(double a, double b, double c) {
  if (a < b) std::swap(a, b);
  if (b < c) std::swap(b, c);
  if (a < b) std::swap(a, b);  // now a >= b >= c; the parentheses below matter
  const double product = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
  return product > 0 ? 0.25 * std::sqrt(product) : 0;
}

std::array<double, 3> bounded_cotangents(double a, double b, double c) {
  const double area = triangle_area(a, b, c);
  if (!(area > 0)) return {0, 0, 0};
  // cot(alpha) = (b^2 + c^2 - a^2) / (4 area); b^2 - a^2 as a product loses no digits.
  std::array<double, 3> cot = {((b - a) * (b + a) + c * c) / (4 * area),
                               ((c - b) * (c + b) + a * a) / (4 * area),
                               ((a - c) * (a + c) + b * b) / (4 * area)};
  const double largest = std::max({std::abs(cot[0]), std::abs(cot[1]), std::abs(cot[2])});
  if (!std::isfinite(largest)) return {0, 0, 0};
  for (double& x : cot) x *= std::min(1.0, 100 / largest);
  return cot;
}

}  // namespace furrow::geometry
