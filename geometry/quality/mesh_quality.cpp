// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/fold/fold_base.h"
#include "geometry/mesh/border_loops.h"
#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/property_names.h"
#include "geometry/quality/fold_quality.h"
#include "geometry/rest/rest_metric.h"

namespace furrow::geometry {
namespace {

constexpr double hem_arc = 0.006;  ///< [m]
constexpr double in_degrees = 180 / std::numbers::pi;

/// Of all faces [rad]; 0 without any.
double smallest_of(const Mesh& mesh, const std::vector<double>& lengths) {
  double least = mesh.number_of_faces() ? std::numbers::pi : 0;
  for (Face f : mesh.faces()) {
    const TriangleLengths of_face = edge_lengths(mesh, f, lengths);
    least = std::min(least, is_proper_triangle(of_face) ? smallest_angle(of_face) : 0.0);
  }
  return least;
}

std::vector<double> spatial_lengths(const Mesh& mesh) {
  std::vector<double> lengths(mesh.num_edges(), 0);
  for (Edge e : mesh.edges()) lengths[e.idx()] = spatial_length(mesh, e);
  return lengths;
}

HemTurn turn_of_loop(const Mesh& mesh, const BorderLoop& loop) {
  std::vector<Point> points;
  Vector sum(0, 0, 0);
  for (Vertex v : loop.vertices) {
    points.push_back(mesh.point(v));
    sum = sum + (mesh.point(v) - CGAL::ORIGIN);
  }
  return {loop.length, turn_of(points, hem_arc) * in_degrees,
          CGAL::ORIGIN + sum / static_cast<double>(std::max<std::size_t>(points.size(), 1))};
}

}  // namespace

double turn_of(std::span<const Point> loop, double apart) {
  std::vector<Vector> directions;
  std::vector<double> lengths;
  double total = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vector side = loop[(i + 1) % loop.size()] - loop[i];
    const double length = std::sqrt(side.squared_length());
    if (!(length > 0)) continue;
    directions.push_back(side / length), lengths.push_back(length), total += length;
  }
  if (!(total > apart)) return unset_value;
  const std::size_t n = lengths.size();
  std::size_t ahead = 0;
  double ahead_left = lengths[0];  // of the edge that is `apart` farther on
  double way = apart;
  for (; way >= ahead_left; ahead_left = lengths[ahead]) way -= ahead_left, ahead = (ahead + 1) % n;
  ahead_left -= way;
  double sum = 0;
  for (std::size_t here = 0; here < n; ++here)
    for (double left = lengths[here]; left > 0;) {
      const double step = std::min(left, ahead_left);
      const Vector &a = directions[here], &b = directions[ahead];
      const double angle = std::atan2(std::sqrt(CGAL::cross_product(a, b).squared_length()), a * b);
      sum += step * angle * angle;
      left -= step, ahead_left -= step;
      if (ahead_left <= 0) ahead = (ahead + 1) % n, ahead_left = lengths[ahead];
    }
  return std::sqrt(sum / total);
}

MeshQuality measure_quality(const Mesh& mesh, bool with_hems) {
  require_triangles(mesh, "measure_quality");
  MeshQuality q;
  q.vertices = mesh.number_of_vertices();
  q.angle_defect = angle_defect(mesh);
  q.min_angle_deg = smallest_of(mesh, spatial_lengths(mesh)) * in_degrees;
  q.min_rest_angle_deg = smallest_of(mesh, rest_lengths(mesh)) * in_degrees;
  if (with_hems)
    for (const BorderLoop& loop : border_loops(mesh)) q.hems.push_back(turn_of_loop(mesh, loop));
  return q;
}

}  // namespace furrow::geometry
