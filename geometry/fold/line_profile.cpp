// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/line_profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/fold/line_region.h"
#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/preconditions.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {
constexpr double farthest = 1.5;  // ways along edges over straight ones: sqrt(2) on grids of right angles
}  // namespace

double line_profile(double t, double sharpness) {
  if (t >= 1) return 0;
  const double round = (1 + std::cos(std::numbers::pi * t)) / 2;
  return (1 - sharpness) * round + sharpness * (1 - t);
}

std::vector<Lift> lift_by_profile(const Mesh& mesh, std::span<const Vertex> line,
                                  std::span<const StrokeSegment> path, const Stroke& stroke) {
  if (!stroke.width) refuse("lift_by_profile", "the stroke has no width");
  const double half = *stroke.width / 2;
  std::vector<char> own(mesh.num_vertices(), 0);
  for (Vertex v : line) own[v.idx()] = 1;
  const double sharpness = stroke.sharpness.value_or(usual_sharpness);
  std::vector<Lift> lifts;
  for (Vertex v : vertices_within(mesh, line, farthest * half, rest_lengths(mesh))) {
    physics::throw_if_cancelled("wrinkle");
    const double t = own[v.idx()] ? 0 : distance_to(path, mesh.point(v)) / half;
    const double height = stroke.height * line_profile(t, sharpness);
    if (height != 0) lifts.push_back({v, height});
  }
  return lifts;
}

double coarseness(const Mesh& mesh, std::span<const Vertex> region, double width,
                  const std::vector<double>& length_of_edge) {
  std::vector<char> inside(mesh.num_vertices(), 0);
  for (Vertex v : region) inside[v.idx()] = 1;
  double sum = 0, count = 0;
  for (Vertex v : region) {
    if (mesh.is_isolated(v)) continue;
    for (Halfedge h : mesh.halfedges_around_target(mesh.halfedge(v)))
      if (inside[mesh.source(h).idx()] && v < mesh.source(h)) {
        sum += length_of_edge[mesh.edge(h).idx()];
        ++count;
      }
  }
  return count > 0 ? sum / count / (width / 3) : 0;
}

}  // namespace furrow::geometry
