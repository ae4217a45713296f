// SPDX-License-Identifier: MIT
#include "physics/pairs/untangle_layers.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "physics/base/cancel_scope.h"
#include "physics/base/require.h"
#include "physics/pairs/edge_face_crossings.h"
#include "physics/pairs/pair_list.h"
#include "physics/pairs/tangle_moves.h"

namespace furrow::physics {
namespace {

constexpr double too_near = 0.5;  // of a range

class Untangler {
 public:
  Untangler(std::span<Vec3> x, const PairMesh& mesh, const ClothLayers& layers, const UntangleOptions& o)
      : x_(x), mesh_(mesh), layers_(layers), o_(o), moves_(x, mesh, o.farthest * mesh.mean_edge) {}

  UntangleReport run() {
    UntangleReport report;
    State now = look();
    State best = now;
    std::vector<Vec3> best_x = moves_.start();
    report.at_start = int(now.crossings.size());
    const auto may_go_on = [&] { return report.rounds < o_.most_rounds && !is_cancelled(); };
    for (int stale = 0; !now.is_apart() && stale < o_.patience && may_go_on(); ++stale) {
      if (now.crossings.empty())
        spread(now.near);
      else
        move(now.crossings);
      ++report.rounds;
      now = look();
      if (!now.is_better_than(best)) continue;
      best = now;
      best_x.assign(x_.begin(), x_.end());
      stale = -1;
    }
    std::copy(best_x.begin(), best_x.end(), x_.begin());
    report.left = int(best.crossings.size());
    report.near = int(best.near.size());
    report.farthest = moves_.farthest_of(best_x);
    return report;
  }

 private:
  struct State {
    std::vector<EdgeFaceCrossing> crossings;
    std::vector<ListedPair> near = {};  ///< pairs that are too near; known where nothing crosses
    bool is_apart() const { return crossings.empty() && near.empty(); }
    bool is_better_than(const State& other) const {
      return crossings.size() != other.crossings.size()
                 ? crossings.size() < other.crossings.size()
                 : crossings.empty() && near.size() < other.near.size();
    }
  };

  State look() {
    State state{between_layers()};
    if (!state.crossings.empty()) return state;
    for (const ListedPair& p : list_.near(x_, {}, 0))
      if (outer_begins(p) >= 0 && bound_of(p) < (too_near - 1) * p.range) state.near.push_back(p);
    return state;
  }

  /// Its distance, less its range [m].
  double bound_of(const ListedPair& p) const { return std::sqrt(distance_of(p, x_).squared()) - p.range; }

  /// Which of a pair's vertices is the first of the outer primitive; -1: both are of one layer.
  int outer_begins(const ListedPair& p) const {
    const int second = p.key.edges ? 2 : 1;
    const int a = layer(p.vertices[0]), b = layer(p.vertices[std::size_t(second)]);
    return a == b ? -1 : a > b ? 0 : second;
  }

  /// Outer vertices go outwards until they are as far as the cloth is thick.
  void spread(std::span<const ListedPair> near) {
    const std::vector<Vec3> normal = normals();
    std::vector<Vec3> way(x_.size(), Vec3::Zero());
    std::vector<double> farthest(x_.size(), 0);
    for (const ListedPair& p : near) {
      const int begin = outer_begins(p), second = p.key.edges ? 2 : 1;
      const auto is_outer = [&](int i) { return begin == 0 ? i < second : i >= second; };
      Vec3 out = Vec3::Zero();
      for (int i = 0; i < 4; ++i)
        if (!is_outer(i)) out += normal[std::size_t(p.vertices[std::size_t(i)])];
      for (int i = 0; i < 4; ++i) {
        if (!is_outer(i)) continue;
        const std::size_t v = std::size_t(p.vertices[std::size_t(i)]);
        way[v] += out.normalized();
        farthest[v] = std::max(farthest[v], -bound_of(p));
      }
    }
    for (std::size_t i = 0; i < way.size(); ++i)
      if (farthest[i] > 0) moves_.step(i, farthest[i] * way[i].normalized());
  }

  int layer(int v) const { return layers_.of_vertex[std::size_t(v)]; }
  int layer_of_edge(const EdgeFaceCrossing& c) const { return layer(mesh_.edges[std::size_t(c.edge)][0]); }
  int layer_of_face(const EdgeFaceCrossing& c) const {
    return layer(mesh_.triangles[std::size_t(c.triangle)][0]);
  }

  std::vector<EdgeFaceCrossing> between_layers() const {
    std::vector<EdgeFaceCrossing> all = edge_face_crossings(mesh_, x_);
    std::erase_if(all, [this](const EdgeFaceCrossing& c) { return layer_of_edge(c) == layer_of_face(c); });
    return all;
  }

  Vec3 area(const std::array<int, 3>& t) const {
    const Vec3 &a = x_[std::size_t(t[0])], &b = x_[std::size_t(t[1])], &c = x_[std::size_t(t[2])];
    const double sign = layers_.turned[std::size_t(layer(t[0]))] ? -0.5 : 0.5;
    return sign * (b - a).eval().cross((c - a).eval());
  }

  /// Outwards, of each vertex; weighted by area.
  std::vector<Vec3> normals() const {
    std::vector<Vec3> normal = vertex_normals(mesh_.triangles, x_);
    for (std::size_t i = 0; i < normal.size(); ++i)
      if (layers_.turned[std::size_t(layer(int(i)))]) normal[i] = -normal[i];
    return normal;
  }

  void move(std::span<const EdgeFaceCrossing> crossings) {
    const std::vector<Vec3> normal = normals();
    std::vector<Vec3> way(x_.size(), Vec3::Zero());
    for (const EdgeFaceCrossing& c : crossings) {
      const auto& e = mesh_.edges[std::size_t(c.edge)];
      const auto& t = mesh_.triangles[std::size_t(c.triangle)];
      const bool face_is_inner = layer_of_face(c) < layer_of_edge(c);
      const Vec3 out = (face_is_inner ? area(t) : Vec3(normal[std::size_t(e[0])] + normal[std::size_t(e[1])]))
                           .normalized();
      if (face_is_inner)
        for (const int v : e) way[std::size_t(v)] += out;
      else
        for (const int v : t) way[std::size_t(v)] += out;
    }
    for (Vec3& w : way)
      if (const double length = w.norm(); length > 0) w /= length;
    moves_.smooth(way);
    moves_.go(way, o_.longest_move * mesh_.mean_edge);
  }

  std::span<Vec3> x_;
  const PairMesh& mesh_;
  const ClothLayers& layers_;
  const UntangleOptions& o_;
  TangleMoves moves_;
  PairList list_{mesh_};
};

void check_layers_of(const char* operation, std::span<const Vec3> x, std::size_t particles,
                     const ClothLayers& layers) {
  if (x.size() != particles || layers.of_vertex.size() != x.size())
    refuse(operation, x.size(), " positions and ", layers.of_vertex.size(), " layers of ", particles);
  for (const int l : layers.of_vertex)
    if (l < 0 || std::size_t(l) >= layers.turned.size()) refuse(operation, "there is no layer ", l);
}

}  // namespace

UntangleReport untangle_layers(std::span<Vec3> x, const PairMesh& mesh, const ClothLayers& layers,
                               const UntangleOptions& options) {
  const char* const operation = "untangle_layers";
  require(operation, "longest_move", options.longest_move, options.longest_move > 0, "> 0");
  require(operation, "farthest", options.farthest, options.farthest > 0, "> 0");
  require(operation, "patience", options.patience, options.patience >= 1, ">= 1");
  check_layers_of(operation, x, mesh.held.size(), layers);
  return Untangler(x, mesh, layers, options).run();
}

}  // namespace furrow::physics
