// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "geometry/mesh/property_names.h"
#include "geometry/quality/fold_quality.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

using Vec3 = Eigen::Vector3d;

constexpr double apart = 1.0 / 40, blur = 0.1;  ///< of points, of the Gaussian, in widths
constexpr double width_of_height = 5;
constexpr std::size_t most_points = 20000;

double length_of(const std::vector<Vec3>& points) {
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

/// Points so far apart, or a little more, along a polyline with its last point.
std::vector<Vec3> resampled(const std::vector<Vec3>& points, double step) {
  const double length = length_of(points);
  const auto n = std::clamp<std::size_t>(static_cast<std::size_t>(length / step), 2, most_points);
  std::vector<Vec3> result;
  std::size_t i = 1;
  double before = 0;
  for (std::size_t k = 0; k <= n; ++k) {
    const double s = length * static_cast<double>(k) / static_cast<double>(n);
    while (i + 1 < points.size() && before + (points[i] - points[i - 1]).norm() < s)
      before += (points[i] - points[i - 1]).norm(), ++i;
    const double piece = (points[i] - points[i - 1]).norm();
    const double t = piece > 0 ? std::clamp((s - before) / piece, 0.0, 1.0) : 0;
    result.push_back((1 - t) * points[i - 1] + t * points[i]);
  }
  return result;
}

/// A Gaussian mean; at ends the curve goes on as its point reflection, so that they stay.
std::vector<Vec3> blurred(const std::vector<Vec3>& points, bool closed, double sigma) {
  const auto n = static_cast<int>(points.size());
  const int reach = std::min(static_cast<int>(std::ceil(3 * sigma)), n - 1);
  const auto at = [&](int i) -> Vec3 {
    if (closed) return points[(i % n + n) % n];
    if (i < 0) return 2 * points.front() - points[-i];
    if (i >= n) return 2 * points.back() - points[2 * (n - 1) - i];
    return points[i];
  };
  std::vector<Vec3> result;
  for (int i = 0; i < n; ++i) {
    physics::throw_if_cancelled("carried_curves");
    Vec3 sum = Vec3::Zero();
    double weights = 0;
    for (int o = -reach; o <= reach; ++o) {
      const double weight = std::exp(-0.5 * o * o / (sigma * sigma));
      sum += weight * at(i + o), weights += weight;
    }
    result.push_back(sum / weights);
  }
  return result;
}

/// Edges of a line as a graph of vertices.
using Graph = std::map<Vertex, std::set<Vertex>>;

/// A chain from a vertex on, its edges taken out of the graph; closed: it ends where it began.
std::vector<Vertex> take_chain(Graph& graph, Vertex from) {
  std::vector<Vertex> chain{from};
  for (Vertex v = from; !graph[v].empty();) {
    const Vertex next = *graph[v].begin();
    graph[v].erase(next), graph[next].erase(v);
    chain.push_back(v = next);
  }
  return chain;
}

std::vector<std::vector<Vertex>> take_chains(Graph graph) {
  std::vector<std::vector<Vertex>> chains;
  for (const bool from_ends : {true, false})
    for (const auto& [v, around] : Graph(graph))
      while (from_ends ? graph[v].size() % 2 == 1 : !graph[v].empty()) chains.push_back(take_chain(graph, v));
  return chains;
}

std::map<int, Graph> graphs_of(const Mesh& mesh) {
  std::map<int, Graph> graphs;
  const auto line = find_map(mesh, attribute::line);
  const auto line_edge = find_map(mesh, attribute::line_edge);
  if (!line || !line_edge) return graphs;
  for (Edge e : mesh.edges()) {
    if (!(*line_edge)[e]) continue;
    const Vertex a = mesh.vertex(e, 0), b = mesh.vertex(e, 1);
    for (int id : std::set<int>{(*line)[a], (*line)[b]})  // where lines meet, an edge may be either's
      if (id >= 0) graphs[id][a].insert(b), graphs[id][b].insert(a);
  }
  return graphs;
}

double at_or(std::span<const double> values, int i, double other) {
  const bool known = static_cast<std::size_t>(i) < values.size() && std::isfinite(values[i]);
  return known ? values[i] : other;
}

double mean_height_of(const FoldSurface& surface, const std::vector<std::vector<Vertex>>& chains) {
  double sum = 0;
  std::size_t count = 0;
  for (const auto& chain : chains)
    for (Vertex v : chain)
      if (surface.has_foot(v)) sum += surface.heights[v.idx()], ++count;
  return count ? sum / static_cast<double>(count) : 0;
}

}  // namespace

FoldCurve curve_of_chain(const FoldSurface& surface, std::span<const Vertex> chain, double width,
                         double height) {
  FoldCurve curve;
  const Mesh& mesh = *surface.mesh;
  std::vector<Vec3> points;
  for (Vertex v : chain)
    if (surface.has_foot(v)) points.push_back(surface.feet[v.idx()]);
  if (points.size() < 2 || !(length_of(points) > 0)) return curve;
  curve.closed = chain.size() > 3 && chain.front() == chain.back();
  points = resampled(points, apart * width);
  const double step = length_of(points) / static_cast<double>(points.size() - 1);
  if (curve.closed) points.pop_back();
  curve.points = blurred(points, curve.closed, blur * width / step);
  curve.arc.assign(1, 0);
  for (std::size_t i = 1; i < curve.points.size(); ++i)
    curve.arc.push_back(curve.arc.back() + (curve.points[i] - curve.points[i - 1]).norm());
  curve.length = curve.arc.back() + (curve.closed ? (curve.points.front() - curve.points.back()).norm() : 0);
  curve.width.assign(curve.points.size(), width);
  curve.height.assign(curve.points.size(), height);
  curve.begins_at_border = !curve.closed && mesh.is_border(chain.front());
  curve.ends_at_border = !curve.closed && mesh.is_border(chain.back());
  if (curve.begins_at_border != curve.ends_at_border)  // as rule fold flares it by default
    curve.rise[curve.begins_at_border ? 1 : 0] = 0.75 * curve.length;
  return curve;
}

std::vector<FoldCurve> carried_curves(const FoldSurface& surface, std::span<const double> widths,
                                      std::span<const double> heights) {
  std::vector<FoldCurve> curves;
  for (const auto& [id, graph] : graphs_of(*surface.mesh)) {
    const auto chains = take_chains(graph);
    const double height = at_or(heights, id, mean_height_of(surface, chains));
    const double width = at_or(widths, id, width_of_height * std::abs(height));
    if (!(width > 0)) continue;
    for (const auto& chain : chains) {
      FoldCurve curve = curve_of_chain(surface, chain, width, height);
      if (curve.length < width) continue;  // where lines meet, edges of the other one
      curve.line = id;
      curves.push_back(std::move(curve));
    }
  }
  return curves;
}

}  // namespace furrow::geometry
