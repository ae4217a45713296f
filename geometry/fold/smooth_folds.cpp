// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/smooth_folds.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <vector>

#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/face_point.h"
#include "geometry/mesh/property_names.h"
#include "geometry/rest/rest_metric.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

constexpr double least_angle = 15;  ///< a face may become as thin by smoothing [degrees]

/// Smallest angle of a face in space [degrees].
double face_angle(const Mesh& mesh, Face f) {
  const auto h = halfedges_of(mesh, f);
  return smallest_angle({spatial_length(mesh, mesh.edge(h[0])), spatial_length(mesh, mesh.edge(h[1])),
                         spatial_length(mesh, mesh.edge(h[2]))}) *
         180 / std::numbers::pi;
}

/// Takes smoothing back at the corners of faces that it made thinner than they were and than least_angle,
/// until there are none; returns at how many vertices.
std::size_t take_back(Mesh& mesh, const std::vector<Point>& before, std::span<const Vertex> region) {
  std::set<Face> faces;
  for (Vertex v : region)
    for (Face f : mesh.faces_around_target(mesh.halfedge(v)))
      if (f.is_valid()) faces.insert(f);
  Mesh unsmoothed = mesh;
  for (Vertex v : region) unsmoothed.point(v) = before[v.idx()];
  std::map<Face, double> wanted;
  physics::throw_if_cancelled("wrinkle");
  for (Face f : faces) wanted[f] = std::min(least_angle, face_angle(unsmoothed, f)) - 1e-6;
  std::set<Vertex> taken;
  for (bool changed = true; changed;) {
    changed = false;
    for (Face f : faces) {
      physics::throw_if_cancelled("wrinkle");
      if (face_angle(mesh, f) >= wanted[f]) continue;
      for (Vertex v : corners_of(mesh, f))
        if (mesh.point(v) != before[v.idx()]) {
          mesh.point(v) = before[v.idx()];
          taken.insert(v);
          changed = true;
        }
    }
  }
  return taken.size();
}

}  // namespace

std::size_t smooth_folds(Mesh& mesh, std::span<const Vertex> region, const TaubinOptions& options) {
  if (region.empty() || options.iterations == 0) return 0;
  TaubinOptions smoothing = options;
  smoothing.weights = SmoothingWeights::cotangent;
  smoothing.lines = LineRule::keep;
  smoothing.border = BorderRule::keep;
  Mesh smoothed = mesh;
  auto rest = ensure_map(smoothed, attribute::rest_length);
  for (Edge e : smoothed.edges()) rest[e] = unset_value;  // cotangents of the mesh as it lies
  taubin_smooth(smoothed, region, smoothing);
  const std::vector<Point> before(mesh.points().begin(), mesh.points().end());
  for (Vertex v : region) mesh.point(v) = smoothed.point(v);
  return take_back(mesh, before, region);
}

}  // namespace furrow::geometry
