// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/cloth_ways.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <string>

#include "geometry/mesh/preconditions.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

/// The way to c over the face (a, b, c), of ways to a and b: f(c) of the linear f with f(a), f(b) and a
/// gradient of length 1, where the front that comes to c crossed ab; else along a side.
double way_over_face(const Point& a, double to_a, const Point& b, double to_b, const Point& c) {
  const Vector side = b - a, across = c - a;
  const double length = std::sqrt(side.squared_length());
  const double along_sides =
      std::min(to_a + std::sqrt(across.squared_length()), to_b + std::sqrt((c - b).squared_length()));
  const double slope = (to_b - to_a) / length;
  if (!(std::abs(slope) < 1)) return along_sides;
  const double x = across * side / length, y = std::sqrt(std::max(0.0, across.squared_length() - x * x));
  const double steep = std::sqrt(1 - slope * slope), from = x - y * slope / steep;
  if (!(from >= 0 && from <= length)) return along_sides;
  return std::min(along_sides, to_a + slope * x + steep * y);
}

class Front {
 public:
  Front(const Mesh& mesh, double reach)
      : mesh_(mesh),
        reach_(reach),
        way_(mesh.num_vertices(), std::numeric_limits<double>::infinity()),
        passed_(mesh.num_vertices(), false) {}

  void offer(Vertex v, double way) {
    if (!(way < way_[v.idx()]) || way > reach_) return;
    way_[v.idx()] = way;
    next_.emplace(way, v);
  }

  std::vector<VertexWay> run() {
    std::vector<VertexWay> result;
    while (!next_.empty()) {
      physics::throw_if_cancelled("wrinkle");
      const auto [way, v] = next_.top();
      next_.pop();
      if (passed_[v.idx()]) continue;
      passed_[v.idx()] = true;
      result.emplace_back(v, way);
      if (!mesh_.is_isolated(v)) pass(v);
    }
    std::sort(result.begin(), result.end());
    return result;
  }

 private:
  void pass(Vertex v) {
    for (Halfedge h : mesh_.halfedges_around_target(mesh_.halfedge(v))) {
      const Vertex a = mesh_.source(h);
      offer(a, way_[v.idx()] + std::sqrt((mesh_.point(a) - mesh_.point(v)).squared_length()));
      if (mesh_.is_border(h)) continue;
      const Vertex b = mesh_.target(mesh_.next(h));
      over(v, a, b);
      over(v, b, a);
    }
  }
  void over(Vertex v, Vertex passed, Vertex to) {
    if (!passed_[passed.idx()] || passed_[to.idx()]) return;
    offer(to, way_over_face(mesh_.point(v), way_[v.idx()], mesh_.point(passed), way_[passed.idx()],
                            mesh_.point(to)));
  }

  using Entry = std::pair<double, Vertex>;  // ties by index
  const Mesh& mesh_;
  const double reach_;
  std::vector<double> way_;
  std::vector<bool> passed_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> next_;
};

}  // namespace

std::vector<VertexWay> ways_along_cloth(const Mesh& mesh, std::span<const Vertex> seeds, double reach) {
  if (!(reach >= 0)) refuse("ways_along_cloth", "reach is " + std::to_string(reach));
  require_vertices(mesh, seeds, "ways_along_cloth");
  Front front(mesh, reach);
  for (Vertex v : seeds) front.offer(v, 0);
  return front.run();
}

}  // namespace furrow::geometry
