// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/hem_folds.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "geometry/mesh/preconditions.h"

namespace furrow::geometry {

int count_peaks(std::span<const double> values, double prominence) {
  if (!(prominence > 0)) refuse("count_peaks", "prominence = " + std::to_string(prominence) + " is not > 0");
  if (!std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); }))
    refuse("count_peaks", "a value is not finite");
  if (values.empty()) return 0;
  // Once around from the lowest value: up by the prominence from the last valley is a peak, down by it from
  // the last peak a valley.
  const std::size_t start = std::min_element(values.begin(), values.end()) - values.begin();
  int peaks = 0;
  bool rising = true;
  double extreme = values[start];
  for (std::size_t i = 0; i <= values.size(); ++i) {
    const double x = values[(start + i) % values.size()];
    if (rising ? x - extreme >= prominence : extreme - x >= prominence) {
      peaks += rising ? 1 : 0;
      rising = !rising;
      extreme = x;
    }
    extreme = rising ? std::min(extreme, x) : std::max(extreme, x);
  }
  return peaks;
}

int count_folds(const Mesh& mesh, const BorderLoop& hem, double prominence) {
  double x = 0, z = 0, length = 0;
  const std::size_t n = hem.vertices.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point &p = mesh.point(hem.vertices[i]), &q = mesh.point(hem.vertices[(i + 1) % n]);
    const double part = std::sqrt(CGAL::squared_distance(p, q));
    x += part * (p.x() + q.x()) / 2;
    z += part * (p.z() + q.z()) / 2;
    length += part;
  }
  if (!(length > 0)) return 0;
  std::vector<double> radius;
  for (Vertex v : hem.vertices)
    radius.push_back(std::hypot(mesh.point(v).x() - x / length, mesh.point(v).z() - z / length));
  return count_peaks(radius, prominence);
}

}  // namespace furrow::geometry
