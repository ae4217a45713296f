// SPDX-License-Identifier: MIT
#include "physics/pairs/pair_list.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/base/require.h"
#include "physics/base/vector_sums.h"
#include "physics/pairs/box_grid.h"
#include "physics/pairs/pair_distance.h"

namespace furrow::physics {
namespace {

constexpr int list_chunks = 16;  // ranges of primitives, whoever works on them

/// Where the cloth is and where it goes.
struct Sweep {
  const PairMesh& mesh;
  std::span<const Vec3> x, plan;
  double margin;
};

template <std::size_t n>
FloatBox swept_box(const Sweep& s, const std::array<int, n>& vertices, const Vec3& origin, double reach) {
  std::array<Vec3, 2 * n> points;
  for (std::size_t i = 0; i < n; ++i) {
    points[i] = s.x[std::size_t(vertices[i])];
    if (!s.plan.empty()) points[n + i] = points[i] + s.plan[std::size_t(vertices[i])];
  }
  return box_around(std::span(points).first(s.plan.empty() ? n : 2 * n), origin, reach);
}

/// How much nearer the two come at most, by the plan [m].
double planned_approach(const Sweep& s, const std::array<int, 4>& v, bool edges) {
  if (s.plan.empty()) return 0;
  const std::size_t split = edges ? 2 : 1;
  double most = 0;
  for (std::size_t i = 0; i < split; ++i)
    for (std::size_t j = split; j < 4; ++j)
      most = std::max(most, (s.plan[std::size_t(v[i])] - s.plan[std::size_t(v[j])]).squaredNorm());
  return std::sqrt(most);
}

/// Whether a plane across the line from middle to middle shows that the two are at least `reach` apart.
bool surely_apart(const Vec3* const x[4], bool edges, double reach) {
  Vec3 between;
  double gap;
  if (edges) {
    between = 0.5 * (*x[2] + *x[3] - *x[0] - *x[1]);
    gap = between.squaredNorm() -
          0.5 * (std::abs(between.dot(*x[1] - *x[0])) + std::abs(between.dot(*x[3] - *x[2])));
  } else {
    between = *x[0] - (1.0 / 3) * (*x[1] + *x[2] + *x[3]);
    const double to = between.dot(*x[0]);
    gap = to - std::max({between.dot(*x[1]), between.dot(*x[2]), between.dot(*x[3])});
  }
  return gap > 0 && gap * gap > reach * reach * between.squaredNorm() * (1 + 1e-9);
}

void add_if_near(const Sweep& s, const PairKey& key, std::vector<ListedPair>& found) {
  const std::array<int, 4> v = vertices_of(s.mesh, key);
  const auto& held = s.mesh.held;
  const bool edges = key.edges;
  if (edges ? v[0] == v[2] || v[0] == v[3] || v[1] == v[2] || v[1] == v[3]
            : v[0] == v[1] || v[0] == v[2] || v[0] == v[3])
    return;
  const Vec3* const x[4] = {&s.x[std::size_t(v[0])], &s.x[std::size_t(v[1])], &s.x[std::size_t(v[2])],
                            &s.x[std::size_t(v[3])]};
  const double range = range_of(s.mesh, key), gone = range + planned_approach(s, v, edges);
  if (surely_apart(x, edges, gone + 2 * s.margin)) return;
  if (held[std::size_t(v[0])] && held[std::size_t(v[1])] && held[std::size_t(v[2])] &&
      held[std::size_t(v[3])])
    return;
  const PairDistance d = edges ? edge_edge_distance(*x[0], *x[1], *x[2], *x[3])
                               : vertex_triangle_distance(*x[0], *x[1], *x[2], *x[3]);
  const double bound = std::sqrt(d.squared()) - gone;
  if (bound < 2 * s.margin) found.push_back({bound, range, key, v});
}

/// What is near to an asking primitive, by chunks of them: edges ask edges, triangles ask vertices.
class NearSearch {
 public:
  explicit NearSearch(const Sweep& sweep) : s_(sweep), origin_(sweep.x[std::size_t(s_.mesh.edges[0][0])]) {
    const PairMesh& m = s_.mesh;
    edge_boxes_.reserve(m.edges.size());
    double sides = 0;
    for (std::size_t e = 0; e < m.edges.size(); ++e) {
      edge_boxes_.push_back(swept_box(s_, m.edges[e], origin_, m.edge_radius[e] + s_.margin));
      const FloatBox& b = edge_boxes_.back();
      sides += std::max({b.high[0] - b.low[0], b.high[1] - b.low[1], b.high[2] - b.low[2]});
    }
    std::vector<FloatBox> vertex_boxes;
    for (std::size_t v = 0; v < m.used.size(); ++v) {
      if (!m.used[v]) continue;
      vertices_.push_back(int(v));
      vertex_boxes.push_back(swept_box(s_, std::array{int(v)}, origin_, m.radius[v] + s_.margin));
    }
    const double cell = std::max(m.mean_edge, sides / double(m.edges.size()));
    grids_.emplace_back(edge_boxes_, cell);
    grids_.emplace_back(vertex_boxes, cell);
  }

  std::vector<ListedPair> chunk(int number) const {
    std::vector<ListedPair> found;
    const PairMesh& m = s_.mesh;
    each_of_chunk(m.edges.size(), number, [&](int e) {
      grids_[0].each_meeting(edge_boxes_[std::size_t(e)], [&](int other) {
        if (other > e) add_if_near(s_, {1, e, other}, found);
      });
    });
    each_of_chunk(m.triangles.size(), number, [&](int t) {
      const FloatBox box =
          swept_box(s_, m.triangles[std::size_t(t)], origin_, m.triangle_radius[std::size_t(t)] + s_.margin);
      grids_[1].each_meeting(box, [&](int v) { add_if_near(s_, {0, vertices_[std::size_t(v)], t}, found); });
    });
    return found;
  }

 private:
  template <class Work>
  static void each_of_chunk(std::size_t n, int chunk, const Work& work) {
    const auto end = int(std::int64_t(n) * (chunk + 1) / list_chunks);
    for (int i = int(std::int64_t(n) * chunk / list_chunks); i < end; ++i) work(i);
  }

  const Sweep& s_;
  const Vec3 origin_;
  std::vector<FloatBox> edge_boxes_;
  std::vector<int> vertices_;
  std::vector<BoxGrid> grids_;  ///< of edges, of vertices
};

bool listed_before(const ListedPair& a, const ListedPair& b) {
  return a.bound != b.bound ? a.bound < b.bound : a.key < b.key;
}

}  // namespace

PairList::PairList(const PairMesh& mesh, std::span<const Vec3> x, std::span<const Vec3> plan, double margin,
                   ThreadPool* pool)
    : margin_(margin), x_(x.begin(), x.end()), plan_(plan.begin(), plan.end()) {
  require("PairList", "margin", margin, margin >= 0, ">= 0");
  if (x.size() != mesh.radius.size() || (!plan.empty() && plan.size() != x.size()))
    refuse("PairList", x.size(), " positions and ", plan.size(), " moves of ", mesh.radius.size(),
           " particles");
  if (mesh.edges.empty()) return;
  const Sweep sweep{mesh, x_, plan_, margin};
  const NearSearch search(sweep);
  std::array<std::vector<ListedPair>, list_chunks> found;
  const auto work = [&](int i, int) { found[std::size_t(i)] = search.chunk(i); };
  if (pool)
    pool->share(list_chunks, work);
  else
    for (int i = 0; i < list_chunks; ++i) work(i, 0);
  for (const auto& part : found) pairs_.insert(pairs_.end(), part.begin(), part.end());
  std::sort(pairs_.begin(), pairs_.end(), listed_before);
  const auto same = [](const ListedPair& a, const ListedPair& b) { return a.key == b.key; };
  pairs_.erase(std::unique(pairs_.begin(), pairs_.end(), same), pairs_.end());
}

double PairList::excess(std::span<const Vec3> x) const {
  if (margin_ < 0) return std::numeric_limits<double>::infinity();
  double s = 0;
  if (!plan_.empty()) {
    double along = 0;
    for (std::size_t i = 0; i < x.size(); ++i) along += (x[i] - x_[i]).dot(plan_[i]);
    const double length = dot(plan_, plan_);
    s = length > 0 ? std::clamp(along / length, 0.0, 1.0) : 0;
  }
  double most = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vec3 off = s > 0 ? Vec3(x[i] - x_[i] - s * plan_[i]) : Vec3(x[i] - x_[i]);
    most = std::max(most, off.squaredNorm());
  }
  return std::sqrt(most) * (1 + 1e-12);
}

std::span<const ListedPair> PairList::within(double excess) const {
  const auto end = std::partition_point(pairs_.begin(), pairs_.end(),
                                        [excess](const ListedPair& p) { return p.bound < 2 * excess; });
  return {pairs_.begin(), end};
}

}  // namespace furrow::physics
