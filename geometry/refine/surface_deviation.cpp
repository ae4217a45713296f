// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/refine/surface_deviation.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/stroke/project_onto_surface.h"

namespace furrow::geometry {
namespace {

constexpr std::array<Barycentrics, 4> points = {
    {{1. / 3, 1. / 3, 1. / 3}, {2. / 3, 1. / 6, 1. / 6}, {1. / 6, 2. / 3, 1. / 6}, {1. / 6, 1. / 6, 2. / 3}}};

struct Sample {
  double distance, area;
};

}  // namespace

SurfaceDeviation surface_deviation(const Mesh& from, const Mesh& to, std::span<const Face> faces) {
  require_triangles(from, "surface_deviation");
  require_triangles(to, "surface_deviation");
  std::vector<Face> all;
  if (faces.empty()) {
    all.assign(from.faces().begin(), from.faces().end());
    faces = all;
  }
  if (faces.empty()) throw ContentError("surface_deviation: the mesh has no faces");
  const SurfaceProjector surface(to);
  std::vector<Sample> samples;
  SurfaceDeviation result;
  for (Face f : faces) {
    const double area = std::sqrt(area_normal_of(from, f).squared_length()) / 2;
    result.area += area;
    for (const Barycentrics& b : points)
      samples.push_back({surface.closest(position_of(from, {f, b})).distance, area / 4});
  }
  std::stable_sort(samples.begin(), samples.end(),
                   [](const Sample& a, const Sample& b) { return a.distance < b.distance; });
  double below = 0;
  bool half = false, most = false;
  for (const Sample& s : samples) {
    below += s.area;
    if (!half && below >= 0.5 * result.area * (1 - 1e-12)) half = true, result.median = s.distance;
    if (!most && below >= 0.95 * result.area * (1 - 1e-12)) most = true, result.p95 = s.distance;
  }
  result.largest = samples.back().distance;
  return result;
}

}  // namespace furrow::geometry
