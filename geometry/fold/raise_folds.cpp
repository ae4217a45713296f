// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/raise_folds.h"

#include <algorithm>
#include <cmath>

#include "geometry/fold/cloth_ways.h"
#include "geometry/fold/fold_base.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/tangent_frames.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

constexpr double pinched = 0.5;  ///< of an edge's length
constexpr int rings_spread = 4, most_spreads = 10;

Eigen::Vector3d coordinates(const Point& p) { return {p.x(), p.y(), p.z()}; }

/// Ways of all vertices from the chains of the curves.
std::vector<std::vector<CurveWay>> ways_from_chains(const Mesh& mesh, const Folds& folds,
                                                    const std::vector<BandChain>& chains) {
  std::vector<std::vector<CurveWay>> result(mesh.num_vertices());
  for (std::size_t i = 0; i < chains.size(); ++i)
    for (const auto& [v, way] : ways_along_cloth(mesh, chains[i].vertices, folds.heights[i].reach()))
      result[v.idx()].push_back({static_cast<int>(i), way});
  return result;
}

/// One vertex of a refined mesh, as Raised holds it.
struct RaisedVertex {
  Point base;
  Vector normal{0, 0, 0};
  double height = 0, set = unset_value;
  std::vector<CurveWay> ways;
};

/// Raises the vertices of a mesh that was refined, those that come and those that move later.
class Raising {
 public:
  Raising(const Mesh& given, const Folds& folds, const RaiseOptions& options, Raised& raised)
      : given_(given),
        folds_(folds),
        flat_(options.flat_base),
        raised_(raised),
        corners_(vertex_normals(given)) {}

  Point base_at(const FacePoint& place) const {
    return flat_ ? position_of(given_, place) : curved_place(given_, corners_, place);
  }

  void raise(RaisedVertex& v) const {
    physics::throw_if_cancelled("wrinkle");
    const Folds::Joined joined = folds_.at(coordinates(v.base), v.ways);
    v.height = joined.height;
    double sum = 0, weights = 0;
    for (const CurveWay& w : v.ways) {
      const double weight = std::abs(joined.of_line.at(folds_.curves[w.curve].line));
      sum += weight * folds_.curves[w.curve].set;
      weights += weight;
    }
    v.set = weights > 0 ? sum / weights : unset_value;
  }

  /// Remembers what it is, for take().
  Point between(const Between& of, const FacePoint& place) {
    last_ = RaisedVertex();
    last_.base = base_at(place);
    for (int i = 0; i < 3; ++i)
      if (of.weights[i] != 0)
        last_.normal = last_.normal + of.weights[i] * raised_.normals[of.vertices[i].idx()];
    last_.normal = normalized(last_.normal);
    last_.ways = ways_between(of);
    raise(last_);
    return last_.base + last_.height * last_.normal;
  }

  void take(Vertex v) {
    const std::size_t i = v.idx(), n = std::max(raised_.base.size(), i + 1);
    raised_.base.resize(n), raised_.normals.resize(n, Vector(0, 0, 0)), raised_.height.resize(n, 0);
    raised_.set.resize(n, unset_value), raised_.ways.resize(n);
    put(i, last_);
  }

  void put(std::size_t i, const RaisedVertex& v) {
    raised_.base[i] = v.base;
    raised_.normals[i] = v.normal;
    raised_.height[i] = v.height;
    raised_.set[i] = v.set;
    raised_.ways[i] = v.ways;
  }

 private:
  /// Means of the ways; beyond a curve's reach they count as that.
  std::vector<CurveWay> ways_between(const Between& of) const {
    std::map<int, double> within, sums;
    for (int i = 0; i < 3; ++i)
      for (const CurveWay& w : of.weights[i] != 0 ? raised_.ways[of.vertices[i].idx()] : none_) {
        within[w.curve] += of.weights[i];
        sums[w.curve] += of.weights[i] * w.way;
      }
    std::vector<CurveWay> result;
    for (const auto& [curve, sum] : sums)
      result.push_back({curve, sum + (1 - within[curve]) * folds_.heights[curve].reach()});
    return result;
  }

  const Mesh& given_;
  const Folds& folds_;
  const bool flat_;
  Raised& raised_;
  const std::vector<Vector> corners_;
  const std::vector<CurveWay> none_;
  RaisedVertex last_;
};

std::vector<Point> base_of(const Mesh& mesh, const BandReport& band, const Raising& raising,
                           const std::set<Vertex>& held) {
  std::vector<Point> base(mesh.points().begin(), mesh.points().end());
  for (Vertex v : mesh.vertices()) {
    physics::throw_if_cancelled("wrinkle");
    const FacePoint& place = band.places[v.idx()];
    if (held.count(v) || !place.face.is_valid()) continue;
    const auto& b = place.barycentrics;
    if (std::max({b[0], b[1], b[2]}) == 1) continue;  // a vertex of the mesh given
    base[v.idx()] = raising.base_at(place);
  }
  return base;
}

/// Ends of edges that raising makes shorter than `pinched`, with some rings around them: there a fold rises
/// into a hollow, whose normals meet.
std::vector<bool> pinched_region(const Mesh& mesh, const Raised& raised) {
  std::vector<bool> marked(mesh.num_vertices(), false);
  for (Edge e : mesh.edges()) {
    const Vertex a = mesh.vertex(e, 0), b = mesh.vertex(e, 1);
    const double before = CGAL::squared_distance(raised.base[a.idx()], raised.base[b.idx()]);
    if (CGAL::squared_distance(raised.displaced(a), raised.displaced(b)) < pinched * pinched * before)
      marked[a.idx()] = marked[b.idx()] = true;
  }
  for (int ring = 0; ring < rings_spread && std::find(marked.begin(), marked.end(), true) != marked.end();
       ++ring) {
    std::vector<bool> wider = marked;
    for (Edge e : mesh.edges()) {
      const Vertex a = mesh.vertex(e, 0), b = mesh.vertex(e, 1);
      if (marked[a.idx()] || marked[b.idx()]) wider[a.idx()] = wider[b.idx()] = true;
    }
    marked.swap(wider);
  }
  return marked;
}

/// Averages the normals further where they meet below the heights, until they do not.
void spread_normals(const Mesh& mesh, Raised& raised) {
  for (int spread = 0; spread < most_spreads; ++spread) {
    const std::vector<bool> marked = pinched_region(mesh, raised);
    if (std::find(marked.begin(), marked.end(), true) == marked.end()) return;
    average_normals(mesh, marked, raised.normals);
  }
}

}  // namespace

Folds::Folds(std::vector<FoldCurve> list) : curves(std::move(list)) {
  for (const FoldCurve& curve : curves) heights.emplace_back(curve);
}

Folds::Joined Folds::at(const Eigen::Vector3d& x, const std::vector<CurveWay>& of) const {
  Joined joined;
  for (const CurveWay& w : of) {
    double& line = joined.of_line[curves[w.curve].line];
    if (const double height = heights[w.curve].at(x); height != 0)
      line += height * heights[w.curve].share_at(x, w.way);
  }
  std::vector<double> list;
  for (const auto& [line, height] : joined.of_line) list.push_back(height);
  joined.height = joined_heights(list);
  return joined;
}

Mesh with_points(const Mesh& mesh, const std::vector<Point>& points) {
  Mesh copy = mesh;
  for (Vertex v : copy.vertices()) copy.point(v) = points[v.idx()];
  return copy;
}

Raised raise_folds(const Mesh& given, Mesh& mesh, BandReport& band, const Folds& folds,
                   const RaiseOptions& options) {
  Raised raised;
  Raising raising(given, folds, options, raised);
  const std::set<Vertex> held(options.band.held.begin(), options.band.held.end());
  raised.base = options.flat_base ? std::vector<Point>(mesh.points().begin(), mesh.points().end())
                                  : base_of(mesh, band, raising, held);
  raised.normals = averaged_normals(with_points(mesh, raised.base));
  raised.ways = ways_from_chains(mesh, folds, band.chains);
  raised.height.assign(raised.base.size(), 0);
  raised.set.assign(raised.base.size(), unset_value);
  for (Vertex v : mesh.vertices()) {
    const std::size_t i = v.idx();
    if (raised.ways[i].empty() || held.count(v)) continue;
    RaisedVertex one{raised.base[i], raised.normals[i], 0, unset_value, raised.ways[i]};
    raising.raise(one);
    raising.put(i, one);
  }
  spread_normals(mesh, raised);
  std::vector<Point> displaced;
  for (Vertex v : mesh.vertices()) displaced.push_back(raised.displaced(v));
  const Displacing displacing{
      [&](const Between& of, const FacePoint& place) { return raising.between(of, place); },
      [&](Vertex v) { raising.take(v); }};
  refine_displaced(mesh, given, folds.curves, displaced, displacing, band, options.band);
  return raised;
}

}  // namespace furrow::geometry
