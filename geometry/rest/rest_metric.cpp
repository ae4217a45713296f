// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/rest/rest_metric.h"

#include <algorithm>
#include <cmath>

#include "geometry/mesh/edge_metric.h"

namespace furrow::geometry {

EdgeMap<double> ensure_rest_lengths(Mesh& mesh) {
  EdgeMap<double> rest = ensure_map(mesh, attribute::rest_length);
  for (Edge e : mesh.edges()) {
    if (!std::isnan(rest[e])) continue;
    rest[e] = spatial_length(mesh, e);
  }
  return rest;
}

TriangleLengths rest_lengths_of(const Mesh& mesh, const EdgeMap<double>& rest, Face face) {
  const auto h = halfedges_of(mesh, face);
  return {rest[mesh.edge(h[0])], rest[mesh.edge(h[1])], rest[mesh.edge(h[2])]};
}

double triangle_area(const TriangleLengths& lengths) {
  if (std::isnan(lengths[0] + lengths[1] + lengths[2])) return unset_value;
  return triangle_area(lengths[0], lengths[1], lengths[2]);
}

std::array<double, 3> triangle_angles(const TriangleLengths& lengths) {
  const double area4 = 4 * triangle_area(lengths);
  std::array<double, 3> angles;
  for (int i = 0; i < 3; ++i) {
    const double next = lengths[i], previous = lengths[(i + 2) % 3], opposite = lengths[(i + 1) % 3];
    angles[i] = std::atan2(area4, next * next + previous * previous - opposite * opposite);
  }
  return angles;
}

double smallest_angle(const TriangleLengths& lengths) {
  const auto angles = triangle_angles(lengths);
  return *std::min_element(angles.begin(), angles.end());
}

bool is_proper_triangle(const TriangleLengths& lengths) {
  const double longest = *std::max_element(lengths.begin(), lengths.end());
  for (double l : lengths) {
    if (!std::isfinite(l) || !(l > 0)) return false;
  }
  return triangle_area(lengths) >= 1e-12 * longest * longest;
}

std::array<double, 3> lengths_to_corners(const TriangleLengths& lengths, const Barycentrics& barycentrics) {
  std::array<double, 3> result;
  for (int corner = 0; corner < 3; ++corner) {
    Barycentrics u = barycentrics;
    u[corner] = -(u[(corner + 1) % 3] + u[(corner + 2) % 3]);
    double squared = 0;
    for (int i = 0; i < 3; ++i) squared -= lengths[i] * lengths[i] * u[i] * u[(i + 1) % 3];
    result[corner] = std::sqrt(std::max(squared, 0.0));
  }
  return result;
}

Barycentrics incenter(const TriangleLengths& lengths) {
  const double sum = lengths[0] + lengths[1] + lengths[2];
  return {lengths[1] / sum, lengths[2] / sum, lengths[0] / sum};
}

double UnfoldedPair::flipped_length() const { return std::hypot(c[0] - d[0], c[1] - d[1]); }

std::array<double, 2> UnfoldedPair::flipped_areas() const {
  const double left = 0.5 * (d[0] * c[1] - d[1] * c[0]);
  const double right = 0.5 * ((c[0] - length) * d[1] - c[1] * (d[0] - length));
  return {left, right};
}

UnfoldedPair unfold(const Mesh& mesh, const EdgeMap<double>& rest, Edge edge) {
  const Halfedge h = mesh.halfedge(edge), o = mesh.opposite(h);
  const double length = rest[edge];
  const auto apex = [&](double from_a, double from_b) {
    const double x = (length * length + from_a * from_a - from_b * from_b) / (2 * length);
    return std::array<double, 2>{x, std::sqrt(std::max(0.0, from_a * from_a - x * x))};
  };
  const auto c = apex(rest[mesh.edge(mesh.prev(h))], rest[mesh.edge(mesh.next(h))]);
  auto d = apex(rest[mesh.edge(mesh.next(o))], rest[mesh.edge(mesh.prev(o))]);
  d[1] = -d[1];
  return {length, c, d};
}

double cotangent_sum(const Mesh& mesh, const EdgeMap<double>& rest, Edge edge) {
  double sum = 0;
  for (Halfedge h : {mesh.halfedge(edge), mesh.opposite(mesh.halfedge(edge))}) {
    const double l = rest[edge], a = rest[mesh.edge(mesh.next(h))], b = rest[mesh.edge(mesh.prev(h))];
    sum += (a * a + b * b - l * l) / (4 * triangle_area({l, a, b}));
  }
  return sum;
}

}  // namespace furrow::geometry
