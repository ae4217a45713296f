// SPDX-License-Identifier: MIT
#include "physics/body/surface_sides.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "physics/base/cancel_scope.h"
#include "physics/body/triangle_crossings.h"

namespace furrow::physics {
namespace {

constexpr int comparisons = 2000;
/// Every fifth comes first, spread over the body. They are all that is compared where each sums over more
/// triangles than `dear`, as beside a fan, whose triangles all have their middle far from their ends.
constexpr int every = 5;  ///< odd, so that both sides of the surface have as many
constexpr std::int64_t dear = 5000;
/// Of those, every fifth comes first again, and is all where each sums over more than this.
constexpr std::int64_t very_dear = 50000;
constexpr double most_disagreement = 0.005;

/// The i-th of a fixed sequence of evenly spread numbers in [0, 1).
double spread(int i, double step) { return i * step - std::floor(i * step); }

double volume_of(const TriangleMesh& mesh, const Vec3& centre) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += (mesh.vertices[a] - centre).dot((mesh.vertices[b] - centre).cross(mesh.vertices[c] - centre)) / 6;
  return sum;
}

}  // namespace

SurfaceSides::SurfaceSides(const TriangleMesh& mesh, const TriangleBvh& bvh, SurfaceTopology topology,
                           SignTest test)
    : bvh_(bvh),
      topology_(std::move(topology)),
      winding_(bvh),
      outer_(mesh.triangles.size(), unknown),
      dropped_(mesh.triangles.size(), 0) {
  report_.closed = topology_.closed;
  report_.border_edges = topology_.border_edges;
  report_.irregular_edges = topology_.irregular_edges;
  report_.signed_volume = volume_of(mesh, bvh.centre());
  const std::vector<char> crossed = crossed_triangles(bvh, topology_);
  report_.crossed_triangles = static_cast<int>(std::count(crossed.begin(), crossed.end(), 1));
  if (topology_.closed) number_parts(crossed);
  find_inner_walls(crossed);
  if (topology_.closed) {
    leave_out_unsound(crossed);
    compare_signs(mesh, test);
  }
}

double SurfaceSides::beside(int triangle, double side) const {
  const auto& [a, b, c] = bvh_.corners(triangle);
  const double size = std::sqrt((b - a).cross(c - a).norm());
  return winding_.at((a + b + c) / 3 + side * 1e-5 * size * topology_.normals[triangle]);
}

void SurfaceSides::number_parts(const std::vector<char>& crossed) {
  const auto usable = [&](int t) { return topology_.sound[t] && !crossed[t]; };
  std::vector<int> part;
  for (std::size_t first = 0; first < outer_.size(); ++first) {
    if (outer_[first] != unknown || !usable(static_cast<int>(first))) continue;
    part.assign(1, static_cast<int>(first));
    outer_[first] = 0;
    for (std::size_t i = 0; i < part.size(); ++i)
      for (int next : topology_.neighbours[part[i]])
        if (next != SurfaceTopology::none && outer_[next] == unknown && usable(next)) {
          outer_[next] = 0;
          part.push_back(next);
        }
    const auto area = [&](int t) {
      const auto& [a, b, c] = bvh_.corners(t);
      return (b - a).cross(c - a).norm();
    };
    const int largest =
        *std::max_element(part.begin(), part.end(), [&](int s, int t) { return area(s) < area(t); });
    const int w = static_cast<int>(std::lround(beside(largest, 1)));
    for (int t : part) outer_[t] = w;
  }
}

void SurfaceSides::leave_out_unsound(const std::vector<char>& crossed) {
  std::vector<char> doubtful(topology_.vertices, 0);
  for (std::size_t t = 0; t < outer_.size(); ++t)
    if (crossed[t] || !topology_.sound[t])
      for (int v : topology_.triangles[t]) doubtful[v] = 1;
  for (std::size_t t = 0; t < outer_.size(); ++t)
    for (int v : topology_.triangles[t])
      if (doubtful[v]) outer_[t] = unknown;
}

void SurfaceSides::find_inner_walls(const std::vector<char>& crossed) {
  for (std::size_t t = 0; t < outer_.size(); ++t) {
    const int i = static_cast<int>(t);
    if (t % 256 == 0) throw_if_cancelled("SurfaceSides");
    if (outer_[t] != unknown)
      dropped_[t] = outer_[t] >= 1;
    else if (!topology_.closed && !crossed[t])
      dropped_[t] = beside(i, 1) > 0.5 && beside(i, -1) > 0.5;
  }
  report_.dropped_triangles = static_cast<int>(std::count(dropped_.begin(), dropped_.end(), 1));
  if (report_.dropped_triangles < static_cast<int>(dropped_.size())) return;
  std::fill(dropped_.begin(), dropped_.end(), 0);  // a body that is all inner wall keeps its surface
  report_.dropped_triangles = 0;
}

/// At the i-th of all places near the surface: adds to the counts and to the triangles summed over.
void SurfaceSides::compare_signs_at(int i, double reach, Comparison& sum) {
  throw_if_cancelled("SurfaceSides");
  const auto triangles = static_cast<std::int64_t>(outer_.size());
  const int t = static_cast<int>(i * triangles / comparisons);
  if (topology_.normals[t].isZero()) return;
  const double u = spread(i, 0.7548776662466927), v = spread(i, 0.5698402909980532);  // R2 sequence
  const auto& [a, b, c] = bvh_.corners(t);
  const double s = u + v < 1 ? u : 1 - u, r = u + v < 1 ? v : 1 - v;
  const Vec3 on = a + s * (b - a) + r * (c - a);
  const Vec3 x =
      on + (i % 2 ? reach : -reach) * (0.1 + 0.9 * spread(i, 0.6180339887498949)) * topology_.normals[t];
  const ClosestPoint q = bvh_.closest(x, t);
  const bool by_winding = winding_.at(x, &sum.summed) > 0.5;
  const bool by_normal = (x - q.point).dot(pseudonormal(topology_, q.triangle, q.feature)) < 0;
  ++report_.samples;
  sum.differing += by_winding != by_normal;
  sum.known += is_cheap(q.triangle);
  sum.differing_known += is_cheap(q.triangle) && inside(x, q) != by_winding;
}

void SurfaceSides::compare_signs(const TriangleMesh& mesh, SignTest test) {
  report_.rule = SignRule::sides;
  const double reach = 1e-3 * bounding_diagonal(mesh);
  Comparison sum;
  for (int i = 0; i < comparisons; i += every * every) compare_signs_at(i, reach, sum);
  const bool few = sum.summed > very_dear * report_.samples;
  for (int i = 0; i < comparisons && !few; i += every)
    if (i % (every * every) != 0) compare_signs_at(i, reach, sum);
  if (test == SignTest::whole && sum.summed <= dear * report_.samples)
    for (int i = 0; i < comparisons; ++i)
      if (i % every != 0) compare_signs_at(i, reach, sum);
  report_.disagreement = report_.samples ? static_cast<double>(sum.differing) / report_.samples : 0;
  const bool plain = std::all_of(outer_.begin(), outer_.end(), [](int w) { return w == 0; });
  if (sum.differing_known > most_disagreement * sum.known)
    report_.rule = SignRule::winding;
  else if (plain && report_.disagreement <= most_disagreement)
    report_.rule = SignRule::pseudonormal;
}

bool SurfaceSides::inside(const Vec3& x, const ClosestPoint& q) const {
  if (!is_cheap(q.triangle)) return winding_.at(x) > 0.5;
  const bool behind = (x - q.point).dot(pseudonormal(topology_, q.triangle, q.feature)) < 0;
  return outer_[q.triangle] + (behind ? 1 : 0) >= 1;
}

}  // namespace furrow::physics
