// SPDX-License-Identifier: MIT
#include "physics/pairs/pair_list.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/base/require.h"
#include "physics/pairs/pair_distance.h"

namespace furrow::physics {
namespace {

constexpr int list_chunks = 16;     // ranges of primitives, whoever works on them
constexpr double most_movers = 4;   // one of so many vertices: beyond, all is detected anew
constexpr double most_patched = 1;  // the same of all movers since then
constexpr double rounding = 1e-12;  // m

/// Not less, in single precision.
float rounded_up(double value) {
  return float(value * (1 + 2 * double(std::numeric_limits<float>::epsilon())));
}

/// Not more.
float rounded_down(double value) {
  const auto result = float(value);
  return double(result) > value ? std::nextafter(result, -std::numeric_limits<float>::infinity()) : result;
}

/// How much nearer the two of each pair come at most, by the plans of their vertices [m].
Float4 planned_approach(const FourPairs& plan, bool edges) {
  Float4 most = splat(0);
  const std::size_t split = edges ? 2 : 1;
  for (std::size_t i = 0; i < split; ++i)
    for (std::size_t j = split; j < 4; ++j) {
      const Float4 x = plan.at[i].x - plan.at[j].x, y = plan.at[i].y - plan.at[j].y,
                   z = plan.at[i].z - plan.at[j].z;
      most = max(most, x * x + y * y + z * z);
    }
  constexpr float rounds = 8 * std::numeric_limits<float>::epsilon();
  return (1 + rounds) * square_root(most) + rounds * plan.size;
}

template <class Work>
void each_of_chunk(std::size_t n, int chunk, const Work& work) {
  work(int(std::int64_t(n) * chunk / list_chunks), int(std::int64_t(n) * (chunk + 1) / list_chunks));
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

/// What has a vertex that moves.
struct Movers {
  std::vector<int> vertices, edges, triangles;
  std::vector<char> edge_moves, triangle_moves;
};

Movers movers_of(const PairMesh& m, std::span<const int> used, const std::vector<char>& moves) {
  Movers found{{}, {}, {}, std::vector<char>(m.edges.size(), 0), std::vector<char>(m.triangles.size(), 0)};
  for (const int number : used) {
    const auto v = std::size_t(number);
    if (!moves[v]) continue;
    found.vertices.push_back(number);
    for (int i = m.around_begin[v]; i < m.around_begin[v + 1]; ++i) {
      const int t = m.around[std::size_t(i)];
      if (!found.triangle_moves[std::size_t(t)]) found.triangles.push_back(t);
      found.triangle_moves[std::size_t(t)] = 1;
      for (const int e : m.triangle_edges[std::size_t(t)]) {
        const auto& ends = m.edges[std::size_t(e)];
        if (found.edge_moves[std::size_t(e)] || (ends[0] != number && ends[1] != number)) continue;
        found.edge_moves[std::size_t(e)] = 1;
        found.edges.push_back(e);
      }
    }
  }
  return found;
}

}  // namespace

PairDistance distance_of(const ListedPair& pair, std::span<const Vec3> x) {
  return distance_of(pair.key.edges == 1, corners_of(pair.vertices, x));
}

/// Lists those of some candidates that may come near, four at a time, by a bound of their distance; where
/// nothing is planned and that is less than 0, the bound is their distance.
class PairList::Lister {
 public:
  Lister(const PairMesh& mesh, const FloatSweep& sweep, std::span<const Vec3> x, double limit, Lists& found)
      : mesh_(mesh), sweep_(sweep), x_(x), limit_(rounded_up(limit)), exact_limit_(limit), found_(found) {}

  template <bool edges>
  void add(const Candidate& candidate) {
    auto& waiting = waiting_[edges];
    waiting[count_[edges]++] = candidate;
    if (count_[edges] == waiting.size()) judge<edges>();
  }
  void finish() {
    judge<false>();
    judge<true>();
  }

 private:
  template <bool edges>
  std::array<int, 4> vertices(const Candidate& c) const {
    return vertices_of(mesh_, {edges, c.first, c.second});
  }
  template <bool edges>
  void judge() {
    auto& waiting = waiting_[edges];
    const std::size_t count = count_[edges];
    for (std::size_t i = count; i % 4 != 0; ++i) waiting[i] = waiting[count - 1];
    for (std::size_t i = 0; i < count; i += 4)
      judge_four<edges>(&waiting[i], std::min<std::size_t>(4, count - i));
    count_[edges] = 0;
  }
  template <bool edges>
  void judge_four(const Candidate* four, std::size_t count) {
    std::array<const Float4*, 16> at, plan;
    Float4 range;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::array<int, 4> v = vertices<edges>(four[i]);
      for (std::size_t j = 0; j < 4; ++j) at[4 * i + j] = &sweep_.at[std::size_t(v[j])];
      if (!sweep_.plan.empty())
        for (std::size_t j = 0; j < 4; ++j) plan[4 * i + j] = &sweep_.plan[std::size_t(v[j])];
      range[i] = rounded_up(range_of(mesh_, {edges, four[i].first, four[i].second}));
    }
    const FourPairs pairs = four_pairs(at);
    const Separation found = edges ? edge_edge_separation(pairs) : vertex_triangle_separation(pairs);
    const Float4 gone = sweep_.plan.empty() ? range : range + planned_approach(four_pairs(plan), edges);
    const unsigned beyond = bits_of(found.beyond(gone + splat(limit_)));
    for (std::size_t i = 0; i < count; ++i)
      if ((beyond >> i & 1u) == 0) list<edges>(four[i], found.bound(i) - gone[i]);
  }
  template <bool edges>
  void list(const Candidate& c, float bound) {
    if (!(bound < limit_)) return;
    const std::array<int, 4> v = vertices<edges>(c);
    if (!may_touch(mesh_, v[0], v[edges ? 2 : 1])) return;
    const auto held = [this](int i) { return mesh_.held[std::size_t(i)] != 0; };
    if (held(v[0]) && held(v[1]) && held(v[2]) && held(v[3])) return;
    if (bound < 0 && sweep_.plan.empty()) {
      const ListedPair pair{range_of(mesh_, {edges, c.first, c.second}), {edges, c.first, c.second}, v};
      const double exact = std::sqrt(distance_of(pair, x_).squared()) - pair.range;
      if (!(exact < exact_limit_)) return;
      bound = rounded_down(exact);
    }
    found_[edges].push_back({bound, c.first, c.second});
  }

  const PairMesh& mesh_;
  const FloatSweep& sweep_;
  std::span<const Vec3> x_;
  float limit_;
  double exact_limit_;
  Lists& found_;
  std::array<std::array<Candidate, 64>, 2> waiting_;
  std::array<std::size_t, 2> count_ = {0, 0};
};

std::size_t PairList::size() const {
  return base_pairs_[0].size() + base_pairs_[1].size() + patch_pairs_[0].size() + patch_pairs_[1].size();
}

std::span<const ListedPair> PairList::near(std::span<const Vec3> x, std::span<const Vec3> way, double margin,
                                           ThreadPool* pool, double ahead) {
  require("PairList", "margin", margin, margin >= 0, ">= 0");
  require("PairList", "ahead", ahead, ahead >= 1, ">= 1");
  if (x.size() != mesh_->radius.size() || (!way.empty() && way.size() != x.size()))
    refuse("PairList", x.size(), " positions and ", way.size(), " moves of ", mesh_->radius.size(),
           " particles");
  near_.clear();
  if (mesh_->edges.empty()) return {};
  if (!holds(x, way)) {
    const bool anew = margin_ < 0 || most_movers * double(movers_) > double(used_.size()) ||
                      most_patched * double(patched_ + movers_) > double(used_.size());
    std::vector<Vec3> plan(way.begin(), way.end());
    for (Vec3& move : plan) move *= ahead;
    if (anew)
      build(x, plan, margin, pool);
    else
      patch(x, plan);
  }
  offer<false>();
  offer<true>();
  return near_;
}

/// The places of those pairs that may touch where vertices are that far off, and that have no mover. Nothing
/// is skipped by a branch, as none could be foreseen.
template <bool edges>
void PairList::pick(std::span<const Listed> pairs, const std::vector<double>& off, double most_off,
                    const std::vector<char>* moves, std::vector<int>& picked) const {
  picked.resize(pairs.size());
  const float most = rounded_up(2 * most_off + 2 * rounding);
  std::size_t near = 0, kept = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    picked[near] = int(i);
    near += pairs[i].bound < most;
  }
  for (std::size_t i = 0; i < near; ++i) {
    const Listed& p = pairs[std::size_t(picked[i])];
    const std::array<int, 4> v = vertices_of(*mesh_, {edges, p.first, p.second});
    const auto at = [&](std::size_t k) { return off[std::size_t(v[k])]; };
    const auto moved = [&](std::size_t k) { return int((*moves)[std::size_t(v[k])]); };
    const double both =
        edges ? std::max(at(0), at(1)) + std::max(at(2), at(3)) : at(0) + std::max({at(1), at(2), at(3)});
    picked[kept] = picked[i];
    kept += std::size_t(double(p.bound) < both + rounding) &
            std::size_t(!moves || (moved(0) | moved(1) | moved(2) | moved(3)) == 0);
  }
  picked.resize(kept);
}

/// Of the base's pairs those without movers, and all of the patch's, where the way asked for may touch.
template <bool edges>
void PairList::offer() {
  const std::vector<Listed>&base = base_pairs_[edges], &patched = patch_pairs_[edges];
  pick<edges>(base, base_off_, base_most_, movers_ > 0 ? &moves_ : nullptr, picked_);
  pick<edges>(patched, patch_off_, 2 * margin_, nullptr, picked_of_patch_);
  const auto add = [this](const Listed& p) {
    ListedPair& pair = near_.emplace_back();  // field by field: the processor would wait for a copy
    pair.key.edges = edges;
    pair.key.first = p.first;
    pair.key.second = p.second;
    const std::array<int, 4> v = vertices_of(*mesh_, {edges, p.first, p.second});
    for (std::size_t i = 0; i < 4; ++i) pair.vertices[i] = v[i];
    pair.range = range_of(*mesh_, {edges, p.first, p.second});
  };
  auto next = picked_of_patch_.begin();
  const auto end = picked_of_patch_.end();
  for (const int i : picked_) {
    const Listed& p = base[std::size_t(i)];
    for (; next != end && before(patched[std::size_t(*next)], p); ++next) add(patched[std::size_t(*next)]);
    add(p);
  }
  for (; next != end; ++next) add(patched[std::size_t(*next)]);
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
  base_most_ = 0;
  bool whole = true;
  for (const int number : used_) {
    const auto v = std::size_t(number);
    base_off_[v] = measure(base_, base_share, v);
    beyond += base_off_[v] > margin_;
    if (!moves_[v]) base_most_ = std::max(base_most_, base_off_[v]);
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

void PairList::build(std::span<const Vec3> x, std::span<const Vec3> plan, double margin, ThreadPool* pool) {
  const PairMesh& m = *mesh_;
  if (used_.empty())
    for (std::size_t v = 0; v < m.used.size(); ++v)
      if (m.used[v]) used_.push_back(int(v));
  base_.x.assign(x.begin(), x.end());
  base_.plan.assign(plan.begin(), plan.end());
  margin_ = margin;
  base_most_ = 0;
  origin_ = x[std::size_t(m.edges[0][0])];
  sweep_.assign(base_.x, base_.plan, origin_);
  search_.place(sweep_, margin);
  std::vector<Lists> found(list_chunks);
  const auto work = [&](int chunk, int) {
    Lister lister(m, sweep_, base_.x, 2 * margin, found[std::size_t(chunk)]);
    each_of_chunk(std::size_t(search_.groups()), chunk, [&](int begin, int end) {
      search_.each_pair(
          begin, end, [&](const Candidate& c) { lister.add<true>(c); },
          [&](const Candidate& c) { lister.add<false>(c); });
    });
    lister.finish();
  };
  if (pool)
    pool->share(list_chunks, work);
  else
    for (int i = 0; i < list_chunks; ++i) work(i, 0);
  base_pairs_ = sorted(found);
  patch_pairs_ = {};
  moves_.assign(x.size(), 0);
  base_off_.assign(x.size(), 0);
  patch_off_.assign(x.size(), 0);
  movers_ = patched_ = 0;
  ++builds_;
}

/// By counting those of each first primitive.
PairList::Lists PairList::sorted(std::span<Lists> parts) const {
  Lists result;
  for (std::size_t kind = 0; kind < 2; ++kind) {
    std::vector<int> begin((kind == 1 ? mesh_->edges.size() : mesh_->radius.size()) + 2, 0);
    std::size_t size = 0;
    for (const Lists& part : parts) {
      size += part[kind].size();
      for (const Listed& p : part[kind]) ++begin[std::size_t(p.first) + 2];
    }
    for (std::size_t i = 2; i < begin.size(); ++i) begin[i] += begin[i - 1];
    auto& all = result[kind];
    all.resize(size);
    for (const Lists& part : parts)
      for (const Listed& p : part[kind]) {
        auto at = std::size_t(begin[std::size_t(p.first) + 1]++);
        for (; at > 0 && before(p, all[at - 1]); --at) all[at] = all[at - 1];
        all[at] = p;
      }
  }
  return result;
}

/// Boxes of movers hold 2 margins, as an end that does not move leaves its place by that much, once this way
/// and once that. Those of the base hold it wherever it is while it is the base.
void PairList::patch(std::span<const Vec3> x, std::span<const Vec3> plan) {
  const PairMesh& m = *mesh_;
  for (const int v : used_) moves_[std::size_t(v)] = base_off_[std::size_t(v)] > margin_;
  const Movers movers = movers_of(m, used_, moves_);
  patch_.x.assign(x.begin(), x.end());
  patch_.plan.assign(plan.begin(), plan.end());
  patch_off_.assign(x.size(), 0);
  sweep_.assign(x, plan, origin_);
  base_most_ = 0;
  for (const int v : used_)
    if (!moves_[std::size_t(v)]) base_most_ = std::max(base_most_, base_off_[std::size_t(v)]);
  Lists found;
  Lister lister(m, sweep_, patch_.x, 4 * margin_, found);
  const auto edges = [&](int e, int f) { lister.add<true>({std::min(e, f), std::max(e, f)}); };
  const auto vertices = [&](int v, int t) { lister.add<false>({v, t}); };
  const PairSearch moving =
      search_.among(movers.edges, movers.vertices, movers.triangles, sweep_, 2 * margin_);
  moving.each_pair(
      0, moving.groups(), [&](const Candidate& c) { edges(c.first, c.second); },
      [&](const Candidate& c) { vertices(c.first, c.second); });
  moving.each_pair_with(
      search_, [&](int e, int f) { movers.edge_moves[std::size_t(f)] ? void() : edges(e, f); },
      [&](int v, int t) { movers.triangle_moves[std::size_t(t)] ? void() : vertices(v, t); },
      [&](int t, int v) { moves_[std::size_t(v)] ? void() : vertices(v, t); });
  lister.finish();
  patch_pairs_ = sorted(std::span(&found, 1));
  movers_ = movers.vertices.size();
  patched_ += movers_;
  ++patches_;
}

}  // namespace furrow::physics
