// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/draping/fit_piercing.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "bridge/arrays/convert.h"
#include "bridge/draping/fit_zones.h"
#include "geometry/stroke/pierced_faces.h"
#include "physics/base/cancel_scope.h"

namespace furrow::bridge {
namespace {

constexpr double spacing = 0.005;  // of samples [m]

/// The depth of a triangle's deepest sample [m]; below 0: all lie outside. Samples of a row are passed over
/// where they are too near to the last one to be deeper: distance changes by no more than the way.
double depth_in(const std::array<physics::Vec3, 3>& x, const physics::ExactDistance& distance) {
  double longest = 0;
  for (int i = 0; i < 3; ++i) longest = std::max(longest, (x[(i + 1) % 3] - x[i]).norm());
  const int n = int(std::clamp(std::ceil(longest / spacing), 2.0, 256.0));
  double least = std::numeric_limits<double>::infinity();
  const double step = (x[2] - x[0]).norm() / n;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n;) {
      const physics::Vec3 p = x[0] + double(i) / n * (x[1] - x[0]) + double(j) / n * (x[2] - x[0]);
      const double value = distance.sample(p).value;
      least = std::min(least, value);
      const double passed = step > 0 ? (1 - 1e-9) * (value - least) / step : 0;
      j += 1 + (passed > 0 ? int(std::min(passed, double(n))) : 0);  // not a number: none
    }
  return -least;
}

/// The vertices of these faces, in ascending order.
std::vector<std::size_t> corners_of(const std::vector<std::array<int, 3>>& triangles,
                                    const std::vector<char>& through, std::size_t vertices) {
  std::vector<char> is_corner(vertices, 0);
  for (std::size_t i = 0; i < triangles.size(); ++i)
    if (through[i])
      for (const int v : triangles[i]) is_corner[std::size_t(v)] = 1;
  std::vector<std::size_t> corners;
  for (std::size_t v = 0; v < vertices; ++v)
    if (is_corner[v]) corners.push_back(v);
  return corners;
}

}  // namespace

FitPiercing measure_piercing(const geometry::Mesh& garment, const physics::TriangleMesh& body,
                             const physics::ExactDistance& distance, const std::vector<double>& distances) {
  if (distances.size() < garment.num_vertices())
    throw std::invalid_argument("measure_piercing: " + std::to_string(distances.size()) + " distances for " +
                                std::to_string(garment.num_vertices()) + " vertices");
  std::vector<geometry::Point> points;
  for (const physics::Vec3& x : body.vertices) points.push_back(to_cgal(x));
  std::vector<char> through = geometry::pierced_faces(garment, points, body.triangles);
  FitPiercing result;
  result.faces = std::size_t(std::accumulate(through.begin(), through.end(), 0));
  std::vector<double> depths(garment.num_faces(), 0);
  const auto triangles = triangles_of(garment);
  for (geometry::Face f : garment.faces()) {
    physics::throw_if_cancelled("measure_piercing");
    const std::size_t i = f.idx();
    const std::array<int, 3>& t = triangles[i];
    const auto [least, most] = std::minmax({distances[t[0]], distances[t[1]], distances[t[2]]});
    depths[i] = std::max(0.0, -least);
    if (through[i])
      depths[i] = std::max(depths[i], depth_in({to_eigen(garment.point(geometry::Vertex(t[0]))),
                                                to_eigen(garment.point(geometry::Vertex(t[1]))),
                                                to_eigen(garment.point(geometry::Vertex(t[2])))},
                                               distance));
    through[i] = through[i] || most < 0;
    result.deepest = std::max(result.deepest, depths[i]);
  }
  result.corners = corners_of(triangles, through, garment.num_vertices());
  result.zones = fit_zones(garment, std::move(through), depths, 0).zones;
  return result;
}

}  // namespace furrow::bridge
