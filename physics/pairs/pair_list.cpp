// SPDX-License-Identifier: MIT
#include "physics/pairs/pair_list.h"

#include <algorithm>
#include <cmath>

#include "physics/base/require.h"
#include "physics/pairs/pair_distance.h"

namespace furrow::physics {
namespace {

constexpr int list_chunks = 16;     // ranges of primitives, whoever works on them
constexpr double most_movers = 4;   // one of so many vertices: beyond, all is detected anew
constexpr double most_patched = 1;  // the same of all movers since then
constexpr double rounding = 1e-12;  // m

/// Where the cloth is and where it goes, and up to which bound a pair is listed.
struct Sweep {
  const PairMesh& mesh;
  std::span<const Vec3> x, plan;
  double limit;
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
  if (!may_touch(s.mesh, v[0], v[edges ? 2 : 1])) return;
  const Vec3* const x[4] = {&s.x[std::size_t(v[0])], &s.x[std::size_t(v[1])], &s.x[std::size_t(v[2])],
                            &s.x[std::size_t(v[3])]};
  const double range = range_of(s.mesh, key), gone = range + planned_approach(s, v, edges);
  if (surely_apart(x, edges, gone + s.limit)) return;
  if (held[std::size_t(v[0])] && held[std::size_t(v[1])] && held[std::size_t(v[2])] &&
      held[std::size_t(v[3])])
    return;
  const PairDistance d = edges ? edge_edge_distance(*x[0], *x[1], *x[2], *x[3])
                               : vertex_triangle_distance(*x[0], *x[1], *x[2], *x[3]);
  const double bound = std::sqrt(d.squared()) - gone;
  if (bound < s.limit) found.push_back({bound, range, key, v});
}

PairKey edge_pair(int a, int b) { return {1, std::min(a, b), std::max(a, b)}; }

template <class Work>
void each_of_chunk(std::size_t n, int chunk, const Work& work) {
  const auto end = int(std::int64_t(n) * (chunk + 1) / list_chunks);
  for (int i = int(std::int64_t(n) * chunk / list_chunks); i < end; ++i) work(i);
}

/// The boxes of some primitives on their way; numbers: theirs, null: all.
template <std::size_t n>
std::vector<FloatBox> boxes_of(const Sweep& s, const std::vector<std::array<int, n>>& primitives,
                               const std::vector<double>& radius, const std::vector<int>* numbers,
                               const Vec3& origin, double margin) {
  std::vector<FloatBox> boxes;
  const std::size_t count = numbers ? numbers->size() : primitives.size();
  boxes.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = numbers ? std::size_t((*numbers)[i]) : i;
    boxes.push_back(swept_box(s, primitives[at], origin, radius[at] + margin));
  }
  return boxes;
}

std::vector<FloatBox> vertex_boxes(const Sweep& s, std::span<const int> vertices, const Vec3& origin,
                                   double margin) {
  std::vector<FloatBox> boxes;
  boxes.reserve(vertices.size());
  for (const int v : vertices)
    boxes.push_back(swept_box(s, std::array{v}, origin, s.mesh.radius[std::size_t(v)] + margin));
  return boxes;
}

double mean_side(std::span<const FloatBox> boxes) {
  double sum = 0;
  for (const FloatBox& b : boxes)
    sum += std::max({b.high[0] - b.low[0], b.high[1] - b.low[1], b.high[2] - b.low[2]});
  return boxes.empty() ? 0 : sum / double(boxes.size());
}

/// Of a line, the share at which it is nearest to x, told by the vertices that count.
double share_on(std::span<const Vec3> x, std::span<const Vec3> from, std::span<const Vec3> plan,
                std::span<const int> vertices, std::span<const char> left_out) {
  if (plan.empty()) return 0;
  double along = 0, length = 0;
  for (const int number : vertices) {
    const auto v = std::size_t(number);
    if (!left_out.empty() && left_out[v]) continue;
    along += (x[v] - from[v]).dot(plan[v]);
    length += plan[v].squaredNorm();
  }
  return length > 0 ? std::clamp(along / length, 0.0, 1.0) : 0;
}

/// Which primitives have a vertex that moves; numbers of those.
template <std::size_t n>
std::vector<int> moving(const std::vector<std::array<int, n>>& primitives, const std::vector<char>& moves,
                        std::vector<char>& moving) {
  std::vector<int> numbers;
  moving.assign(primitives.size(), 0);
  for (std::size_t i = 0; i < primitives.size(); ++i)
    for (const int v : primitives[i])
      if (!moving[i] && moves[std::size_t(v)]) {
        moving[i] = 1;
        numbers.push_back(int(i));
      }
  return numbers;
}

}  // namespace

std::span<const ListedPair> PairList::near(std::span<const Vec3> x, std::span<const Vec3> way, double margin,
                                           ThreadPool* pool) {
  require("PairList", "margin", margin, margin >= 0, ">= 0");
  if (x.size() != mesh_->radius.size() || (!way.empty() && way.size() != x.size()))
    refuse("PairList", x.size(), " positions and ", way.size(), " moves of ", mesh_->radius.size(),
           " particles");
  near_.clear();
  if (mesh_->edges.empty()) return {};
  if (!holds(x, way)) {
    const bool anew = margin_ < 0 || most_movers * double(movers_) > double(used_.size()) ||
                      most_patched * double(patched_ + movers_) > double(used_.size());
    if (anew)
      build(x, way, margin, pool);
    else
      patch(x, way);
  }
  const auto off = [](const std::vector<double>& by_vertex, const ListedPair& p) {
    const auto at = [&](int i) { return by_vertex[std::size_t(p.vertices[std::size_t(i)])]; };
    return p.key.edges ? std::max(at(0), at(1)) + std::max(at(2), at(3))
                       : at(0) + std::max({at(1), at(2), at(3)});
  };
  const auto of_base = [this](const ListedPair& p) {
    return std::none_of(p.vertices.begin(), p.vertices.end(),
                        [this](int v) { return moves_[std::size_t(v)] != 0; });
  };
  for (const ListedPair& p : base_pairs_)
    if (p.bound < off(base_off_, p) + rounding && of_base(p)) near_.push_back(p);
  for (const ListedPair& p : patch_pairs_)
    if (p.bound < off(patch_off_, p) + rounding) near_.push_back(p);
  return near_;
}

/// How far vertices are from their lines, and whether the list says all there. If not, the movers are told.
bool PairList::holds(std::span<const Vec3> x, std::span<const Vec3> way) {
  if (margin_ < 0) return false;
  const auto measure = [&](const Line& line, double s, std::size_t v) {
    Vec3 off = x[v] - line.x[v];
    if (s > 0) off -= s * line.plan[v];
    return std::sqrt(off.squaredNorm()) + (way.empty() ? 0 : std::sqrt(way[v].squaredNorm()));
  };
  const double base_share = share_on(x, base_.x, base_.plan, used_, moves_);
  std::size_t beyond = 0;
  bool whole = true;
  for (const int number : used_) {
    const auto v = std::size_t(number);
    base_off_[v] = measure(base_, base_share, v);
    beyond += base_off_[v] > margin_;
    whole = whole && (moves_[v] || base_off_[v] <= margin_);
  }
  if (movers_ > 0 && whole) {
    const double share = share_on(x, patch_.x, patch_.plan, used_, {});
    for (const int number : used_) {
      const auto v = std::size_t(number);
      patch_off_[v] = measure(patch_, share, v);
      whole = whole && patch_off_[v] <= (moves_[v] ? 1 : 2) * margin_;
    }
  }
  if (!whole) movers_ = beyond;
  return whole;
}

void PairList::build(std::span<const Vec3> x, std::span<const Vec3> way, double margin, ThreadPool* pool) {
  const PairMesh& m = *mesh_;
  if (used_.empty())
    for (std::size_t v = 0; v < m.used.size(); ++v)
      if (m.used[v]) used_.push_back(int(v));
  base_.x.assign(x.begin(), x.end());
  base_.plan.assign(way.begin(), way.end());
  margin_ = margin;
  origin_ = x[std::size_t(m.edges[0][0])];
  const Sweep s{m, base_.x, base_.plan, 2 * margin};
  const std::vector<FloatBox> edges = boxes_of(s, m.edges, m.edge_radius, nullptr, origin_, margin);
  cell_ = std::max(m.mean_edge, mean_side(edges));
  edge_grid_ = BoxGrid(edges, cell_);
  vertex_grid_ = BoxGrid(vertex_boxes(s, used_, origin_, margin), cell_);
  std::array<std::vector<ListedPair>, list_chunks> found;
  const auto work = [&](int chunk, int) {
    auto& pairs = found[std::size_t(chunk)];
    each_of_chunk(m.edges.size(), chunk, [&](int e) {
      edge_grid_.each_meeting(edges[std::size_t(e)], e, [&](int other) {
        add_if_near(s, {1, e, other}, pairs);
      });
    });
    each_of_chunk(m.triangles.size(), chunk, [&](int t) {
      const auto at = std::size_t(t);
      const FloatBox box = swept_box(s, m.triangles[at], origin_, m.triangle_radius[at] + margin);
      vertex_grid_.each_meeting(box, [&](int v) { add_if_near(s, {0, used_[std::size_t(v)], t}, pairs); });
    });
  };
  if (pool)
    pool->share(list_chunks, work);
  else
    for (int i = 0; i < list_chunks; ++i) work(i, 0);
  base_pairs_.clear();
  for (const auto& part : found) base_pairs_.insert(base_pairs_.end(), part.begin(), part.end());
  patch_pairs_.clear();
  moves_.assign(x.size(), 0);
  base_off_.assign(x.size(), 0);
  patch_off_.assign(x.size(), 0);
  has_triangles_ = false;
  movers_ = patched_ = 0;
  ++builds_;
}

/// Boxes of movers hold 2 margins, as an end that does not move leaves its place by that much, once this way
/// and once that. Those of the base hold it wherever it is while it is the base.
void PairList::patch(std::span<const Vec3> x, std::span<const Vec3> way) {
  const PairMesh& m = *mesh_;
  const Sweep base{m, base_.x, base_.plan, 0};
  if (!has_triangles_)
    triangle_grid_ =
        BoxGrid(boxes_of(base, m.triangles, m.triangle_radius, nullptr, origin_, margin_), cell_);
  has_triangles_ = true;
  std::vector<int> vertices;
  for (const int v : used_) {
    moves_[std::size_t(v)] = base_off_[std::size_t(v)] > margin_;
    if (moves_[std::size_t(v)]) vertices.push_back(v);
  }
  patch_.x.assign(x.begin(), x.end());
  patch_.plan.assign(way.begin(), way.end());
  patch_off_.assign(x.size(), 0);
  patch_pairs_.clear();
  const Sweep s{m, patch_.x, patch_.plan, 4 * margin_};
  std::vector<char> edge_moves, triangle_moves;
  const std::vector<int> edges = moving(m.edges, moves_, edge_moves),
                         triangles = moving(m.triangles, moves_, triangle_moves);
  const auto edge_boxes = boxes_of(s, m.edges, m.edge_radius, &edges, origin_, 2 * margin_);
  const auto triangle_boxes = boxes_of(s, m.triangles, m.triangle_radius, &triangles, origin_, 2 * margin_);
  const auto boxes = vertex_boxes(s, vertices, origin_, 2 * margin_);
  const BoxGrid moving_edges(edge_boxes, cell_), moving_vertices(boxes, cell_);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    edge_grid_.each_meeting(edge_boxes[i], [&](int other) {
      if (!edge_moves[std::size_t(other)]) add_if_near(s, edge_pair(edges[i], other), patch_pairs_);
    });
    moving_edges.each_meeting(edge_boxes[i], int(i), [&](int other) {
      add_if_near(s, edge_pair(edges[i], edges[std::size_t(other)]), patch_pairs_);
    });
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    vertex_grid_.each_meeting(triangle_boxes[i], [&](int v) {
      const int vertex = used_[std::size_t(v)];
      if (!moves_[std::size_t(vertex)]) add_if_near(s, {0, vertex, triangles[i]}, patch_pairs_);
    });
    moving_vertices.each_meeting(triangle_boxes[i], [&](int v) {
      add_if_near(s, {0, vertices[std::size_t(v)], triangles[i]}, patch_pairs_);
    });
  }
  for (std::size_t i = 0; i < vertices.size(); ++i)
    triangle_grid_.each_meeting(boxes[i], [&](int t) {
      if (!triangle_moves[std::size_t(t)]) add_if_near(s, {0, vertices[i], t}, patch_pairs_);
    });
  movers_ = vertices.size();
  patched_ += movers_;
  ++patches_;
}

}  // namespace furrow::physics
