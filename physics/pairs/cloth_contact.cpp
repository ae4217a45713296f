// SPDX-License-Identifier: MIT
#include "physics/pairs/cloth_contact.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "physics/base/cancel_scope.h"
#include "physics/base/require.h"
#include "physics/pairs/barrier.h"
#include "physics/pairs/pair_distance.h"
#include "physics/pairs/time_of_impact.h"

namespace furrow::physics {
namespace {

constexpr double margin_of_edge = 0.1;          // of the mean edge
constexpr double least_margin_of_edge = 0.025;  // where the list is long
constexpr double long_list = 5;                 // pairs a vertex
constexpr double start_share = 0.9;             // of a distance, that a range begins with
constexpr double growth = 1.2;                  // of such a range
constexpr double as_touching = 1e-7;            // m: nearer at the start, a pair counts as crossing
constexpr double cut_short = 1.0 / 32;          // share of a move
constexpr double cut_by_half = 0.5;
constexpr int pair_chunk = 512;
constexpr double ways_ahead = 30;  // of a step among many, for which a list is made
constexpr int most_rounds_of_approach = 40;
constexpr double farthest = 1e6;  // m, that a coordinate goes in a move: single precision has to bear it

/// Not finite if one of them is not.
double largest_coordinate(std::span<const Vec3> move) {
  double largest = 0, sum = 0;
  for (const Vec3& m : move) {
    largest = std::max(largest, m.cwiseAbs().maxCoeff());
    sum += m.sum();
  }
  return std::isnan(sum) ? sum : largest;
}

std::size_t chunks_of(std::size_t n) { return (n + pair_chunk - 1) / pair_chunk; }

/// Runs work(chunk, begin, end) over [0, n) by chunks of a fixed size.
template <class Work>
void by_chunks(std::size_t n, ThreadPool* pool, const Work& work) {
  const int chunks = int(chunks_of(n));
  const auto one = [&](int c, int) {
    work(std::size_t(c), std::size_t(c) * pair_chunk, std::min(n, std::size_t(c + 1) * pair_chunk));
  };
  if (pool && chunks > 1) return pool->share(chunks, one);
  for (int c = 0; c < chunks; ++c) one(c, 0);
}

/// All four are so far apart that a move of this much of their approach leads to a tenth of the lesser of
/// their distance and their range at most: time_of_impact() would be 1.
unsigned surely_free(const FourPairs& x, const FourPairs& move, std::span<const ListedPair> pairs, bool edges,
                     float most) {
  const Separation apart = edges ? edge_edge_separation(x) : vertex_triangle_separation(x);
  const Float4 approach = splat(most) * relative_approach(move, edges);
  Float4 left = splat(0);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const float distance = apart.bound(i);
    left[i] = distance - 0.1001f * std::min(distance, float(pairs[i].range));
  }
  return bits_of((left > splat(0)) & (approach < left));
}

}  // namespace

/// Finds special pairs, asked for in the order of keys.
class ClothContact::Ranges {
 public:
  Ranges(std::span<const SpecialPair> special, const PairKey& first)
      : next_(std::lower_bound(special.begin(), special.end(), first,
                               [](const SpecialPair& p, const PairKey& k) { return p.key < k; })),
        end_(special.end()) {}
  double now(const ListedPair& pair) {
    while (next_ != end_ && next_->key < pair.key) ++next_;
    return next_ != end_ && next_->key == pair.key ? next_->range : pair.range;
  }

 private:
  std::span<const SpecialPair>::iterator next_, end_;
};

bool ClothContact::active_before(const ActivePair& a, const ActivePair& b) { return a.key < b.key; }

ClothContact::ClothContact(const Cloth& cloth, const ClothContactOptions& options,
                           std::span<const Vec3> start, std::span<const Vec3> drawn, ThreadPool* pool)
    : options_(options), friction_(options.friction), margin_share_(margin_of_edge) {
  const char* const operation = "ClothContact";
  require(operation, "thickness", options.thickness, options.thickness > 0, "> 0");
  require(operation, "stiffness", options.stiffness, options.stiffness > 0, "> 0");
  if (start.size() != cloth.particles.size() || (!drawn.empty() && drawn.size() != start.size()))
    refuse(operation, start.size(), " positions and ", drawn.size(), " drawn of ", cloth.particles.size());
  mesh_ = pair_mesh(cloth, options.thickness, options.thicknesses);
  if (!options.groups.empty() && options.groups.size() != start.size())
    refuse(operation, options.groups.size(), " groups of ", start.size(), " particles");
  mesh_.group.assign(options.groups.begin(), options.groups.end());
  options_.thicknesses = {};  // they may go
  options_.groups = {};
  find_special(start, drawn, pool);
}

/// Pairs that are nearer than their range at x.
void ClothContact::note_near(std::span<const Vec3> x, bool at_start, PairList& list, ThreadPool* pool) {
  for (const ListedPair& p : list.near(x, {}, 0, pool)) {
    const double distance = (std::sqrt(distance_of(p, x).squared()) - p.range) + p.range;
    const bool touches = distance < as_touching;
    const double range = touches ? 0 : start_share * distance;
    special_.push_back({p.key, range, at_start || touches ? p.range : range});
  }
}

/// Of each particle, whether it lies at a crossing or next to one.
std::vector<char> ClothContact::around(const std::vector<EdgeFaceCrossing>& crossings) const {
  std::vector<char> lies(mesh_.radius.size(), 0);
  for (const EdgeFaceCrossing& c : crossings) {
    for (const int v : mesh_.edges[std::size_t(c.edge)]) lies[std::size_t(v)] = 1;
    for (const int v : mesh_.triangles[std::size_t(c.triangle)]) lies[std::size_t(v)] = 1;
  }
  return with_neighbours(std::move(lies));
}

/// Pairs that were drawn nearer than their range. Where cloth was drawn through cloth, and two rings around
/// that, the distance does not tell how near it is meant to lie.
void ClothContact::note_drawn(std::span<const Vec3> drawn, PairList& list, ThreadPool* pool) {
  const auto known = std::ptrdiff_t(special_.size());
  note_near(drawn, false, list, pool);
  if (std::ssize(special_) == known) return;
  const std::vector<EdgeFaceCrossing> crossings = edge_face_crossings(mesh_, drawn);
  if (crossings.empty()) return;
  const std::vector<char> crossed = with_neighbours(around(crossings));
  const auto lies_there = [&](const SpecialPair& p) {
    return std::ranges::all_of(vertices_of(mesh_, p.key),
                               [&](int v) { return crossed[std::size_t(v)] != 0; });
  };
  special_.erase(std::remove_if(special_.begin() + known, special_.end(), lies_there), special_.end());
}

void ClothContact::find_special(std::span<const Vec3> x, std::span<const Vec3> drawn, ThreadPool* pool) {
  const std::vector<EdgeFaceCrossing> crossings = edge_face_crossings(mesh_, x);
  crossed_at_start_ = int(crossings.size());
  std::vector<PairKey> crossed;
  for (const EdgeFaceCrossing& c : crossings) add_pairs_of(c, mesh_, crossed);
  for (const PairKey& key : crossed) special_.push_back({key, 0, range_of(mesh_, key)});
  loose_ = around(crossings);
  PairList list(mesh_);  // its margin is none, so it is made anew for each
  note_near(x, true, list, pool);
  if (!drawn.empty()) note_drawn(drawn, list, pool);
  const auto by_key = [](const SpecialPair& a, const SpecialPair& b) { return a.key < b.key; };
  std::stable_sort(special_.begin(), special_.end(), by_key);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < special_.size(); ++i) {
    if (kept > 0 && special_[kept - 1].key == special_[i].key) {
      SpecialPair& p = special_[kept - 1];
      p.range = std::min(p.range, special_[i].range);
      p.target = std::min(p.target, special_[i].target);
    } else {
      special_[kept++] = special_[i];
    }
  }
  special_.resize(kept);
  acted_ = std::any_of(special_.begin(), special_.end(),
                       [](const SpecialPair& p) { return p.range == 0 || p.range < p.target; });
}

const ClothContact::SpecialPair* ClothContact::special_of(const PairKey& key) const {
  const auto at = std::lower_bound(special_.begin(), special_.end(), key,
                                   [](const SpecialPair& p, const PairKey& k) { return p.key < k; });
  return at != special_.end() && at->key == key ? &*at : nullptr;
}

double ClothContact::range_now(const ListedPair& pair) const {
  if (special_.empty()) return pair.range;
  const SpecialPair* special = special_of(pair.key);
  return special ? special->range : pair.range;
}

bool ClothContact::is_loose(const EdgeFaceCrossing& crossing) const {
  const auto& e = mesh_.edges[std::size_t(crossing.edge)];
  const auto& t = mesh_.triangles[std::size_t(crossing.triangle)];
  const auto loose = [this](int v) { return loose_[std::size_t(v)] != 0; };
  return std::all_of(e.begin(), e.end(), loose) && std::all_of(t.begin(), t.end(), loose);
}

/// Sorted; of crossings next to those of the start.
std::vector<PairKey> ClothContact::crossed_now(std::span<const Vec3> x) const {
  std::vector<PairKey> crossed;
  for (const EdgeFaceCrossing& c : edge_face_crossings(mesh_, x))
    if (is_loose(c)) add_pairs_of(c, mesh_, crossed);
  std::sort(crossed.begin(), crossed.end());
  crossed.erase(std::unique(crossed.begin(), crossed.end()), crossed.end());
  return crossed;
}

bool ClothContact::widen(std::span<const Vec3> x) {
  if (special_.empty()) return false;
  const std::vector<PairKey> crossed = exempt() > 0 ? crossed_now(x) : std::vector<PairKey>{};
  std::vector<SpecialPair> more;
  for (const PairKey& key : crossed)
    if (!special_of(key)) more.push_back({key, 0, range_of(mesh_, key)});
  const std::size_t known = special_.size();
  special_.insert(special_.end(), more.begin(), more.end());
  std::inplace_merge(special_.begin(), special_.begin() + std::ptrdiff_t(known), special_.end(),
                     [](const SpecialPair& a, const SpecialPair& b) { return a.key < b.key; });
  bool changed = false;
  for (SpecialPair& p : special_) {
    if (std::binary_search(crossed.begin(), crossed.end(), p.key)) {
      p.range = 0;
    } else if (p.range == 0) {
      const auto corners = corners_of(vertices_of(mesh_, p.key), x);
      const double distance = std::sqrt(distance_of(p.key.edges, corners).squared());
      if (distance < as_touching) continue;
      p.range = std::min(p.target, start_share * distance);
      changed = true;
    } else if (p.range < p.target) {
      p.range = std::min(p.target, growth * p.range);
      changed = true;
    }
  }
  return changed;
}

/// As PairList::near(), with a margin that is the smaller the more is near.
std::span<const ListedPair> ClothContact::near(std::span<const Vec3> x, std::span<const Vec3> way,
                                               ThreadPool* pool, double ahead) {
  const int before = list_.builds();
  const std::span<const ListedPair> pairs = list_.near(x, way, margin_share_ * mesh_.mean_edge, pool, ahead);
  if (list_.builds() > before && double(list_.size()) > long_list * double(x.size()))
    margin_share_ = std::max(least_margin_of_edge, 0.5 * margin_share_);
  return pairs;
}

/// Of what may touch on the way from x by `most` of the move.
std::span<const ListedPair> ClothContact::pairs_on_way(std::span<const Vec3> x, std::span<const Vec3> move,
                                                       double most, ThreadPool* pool) {
  if (most == 1) return near(x, move, pool);
  std::vector<Vec3> way(move.begin(), move.end());
  for (Vec3& m : way) m *= most;
  return near(x, way, pool);
}

/// Of `most` of the move, by each pair; valid until the next call.
const std::vector<double>& ClothContact::shares(std::span<const ListedPair> pairs, std::span<const Vec3> x,
                                                std::span<const Vec3> move, double most, ThreadPool* pool) {
  shares_.assign(pairs.size(), 1.0);
  if (pairs.empty()) return shares_;
  lanes_.assign(x, move, x[std::size_t(pairs[0].vertices[0])]);
  const auto slow = [&](const ListedPair& pair, double range) {
    MovingPair moving{pair.key.edges == 1, corners_of(pair.vertices, x), corners_of(pair.vertices, move)};
    for (Vec3& m : moving.move) m *= most;
    return time_of_impact(moving, range);
  };
  by_chunks(pairs.size(), pool, [&](std::size_t, std::size_t begin, std::size_t end) {
    Ranges ranges(special_, pairs[begin].key);
    each_four(pairs.subspan(begin, end - begin), [&](std::span<const ListedPair> four, bool edges) {
      const unsigned free =
          surely_free(four_of(four, lanes_.at), four_of(four, lanes_.plan), four, edges, float(most));
      for (std::size_t i = 0; i < four.size(); ++i) {
        if (free >> i & 1u) continue;
        const double range = ranges.now(four[i]);
        if (range > 0) shares_[std::size_t(&four[i] - pairs.data())] = slow(four[i], range);
      }
    });
  });
  return shares_;
}

double ClothContact::safe_share(std::span<const Vec3> x, std::span<const Vec3> move, double most,
                                ThreadPool* pool) {
  const double longest = largest_coordinate(move);
  if (!std::isfinite(longest)) return 0;
  most = std::min(most, farthest / std::max(longest, farthest));
  const std::span<const ListedPair> pairs = pairs_on_way(x, move, most, pool);
  const std::vector<double>& share = shares(pairs, x, move, most, pool);
  braced_.clear();
  cuts_.clear();
  double least = 1;
  PairKey first{};
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (share[i] < cut_short) braced_.push_back(brace(pairs[i], x));
    if (share[i] < cut_by_half)
      for (const int v : pairs[i].vertices) cuts_.push_back({v, share[i]});
    if (!(share[i] < least || (share[i] == least && least < 1 && pairs[i].key < first))) continue;
    least = share[i];
    first = pairs[i].key;
    blocked_at_ = x[std::size_t(pairs[i].vertices[0])];
  }
  std::sort(braced_.begin(), braced_.end(), active_before);
  cut_searches_ += least < 1;
  acted_ = acted_ || least < 1;
  blocked_ = least < cut_short ? blocked_ + 1 : 0;
  return least * most;
}

int ClothContact::approach(std::span<Vec3> x, std::span<const Vec3> to, ThreadPool* pool) {
  std::vector<char> stopped(x.size(), 0);
  std::vector<Vec3> way(x.size());
  for (int round = 0; round < most_rounds_of_approach; ++round) {
    throw_if_cancelled("approach");
    for (std::size_t i = 0; i < x.size(); ++i) way[i] = stopped[i] ? Vec3::Zero() : Vec3(to[i] - x[i]);
    const std::span<const ListedPair> pairs = pairs_on_way(x, way, 1, pool);
    const std::vector<double>& share = shares(pairs, x, way, 1, pool);
    const double least = share.empty() ? 1 : std::min(1.0, *std::min_element(share.begin(), share.end()));
    for (std::size_t i = 0; i < x.size(); ++i)
      if (!stopped[i]) x[i] = least == 1 ? to[i] : Vec3(x[i] + least * way[i]);
    if (least == 1) break;
    for (std::size_t i = 0; i < pairs.size(); ++i)
      if (share[i] < std::min(1.0, least + 0.1))  // else what else is listed would count
        for (const int v : pairs[i].vertices) stopped[std::size_t(v)] = 1;
  }
  int left = 0;
  for (std::size_t i = 0; i < x.size(); ++i) left += x[i] != to[i];
  return left;
}

/// Of some pairs, those that are near at the ends of the way or touch on it.
void ClothContact::find_met(std::span<const ListedPair> pairs, std::span<const Vec3> x,
                            std::span<const Vec3> move, std::vector<Met>& found) const {
  found.clear();
  Ranges ranges(special_, pairs[0].key);
  each_four(pairs, [&](std::span<const ListedPair> four, bool edges) {
    const FourPairs at = four_of(four, lanes_.at);
    const Separation apart = edges ? edge_edge_separation(at) : vertex_triangle_separation(at);
    const Float4 approach = relative_approach(four_of(four, lanes_.plan), edges);
    for (std::size_t i = 0; i < four.size(); ++i) {
      const ListedPair& p = four[i];
      if (apart.bound(i) - approach[i] > 1.000001f * float(p.range)) continue;
      const double range = ranges.now(p);
      if (!(range > 0)) continue;
      MovingPair moving{edges, corners_of(p.vertices, x), corners_of(p.vertices, move)};
      std::array<Vec3, 4> end = moving.x;
      for (std::size_t k = 0; k < 4; ++k) end[k] += moving.move[k];
      const PairDistance before = distance_of(edges, moving.x);
      const double share = time_of_impact(moving, range), thick = p.range * p.range;
      if (share < 1 || before.squared() < thick || distance_of(edges, end).squared() < thick)
        found.push_back({p.key, p.vertices, range, before, share});
    }
  });
}

const std::vector<ClothContact::Met>& ClothContact::meet(std::span<const Vec3> x, std::span<const Vec3> move,
                                                         ThreadPool* pool) {
  const std::span<const ListedPair> pairs = near(x, move, pool, ways_ahead);
  met_.clear();
  if (pairs.empty()) return met_;
  lanes_.assign(x, move, x[std::size_t(pairs[0].vertices[0])]);
  met_of_.resize(std::max(met_of_.size(), chunks_of(pairs.size())));
  by_chunks(pairs.size(), pool, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    find_met(pairs.subspan(begin, end - begin), x, move, met_of_[chunk]);
  });
  for (std::size_t c = 0; c < chunks_of(pairs.size()); ++c)
    met_.insert(met_.end(), met_of_[c].begin(), met_of_[c].end());
  return met_;
}

ActivePair ClothContact::brace(const ListedPair& pair, std::span<const Vec3> x) const {
  const PairDistance d = distance_of(pair.key.edges, corners_of(pair.vertices, x));
  const double range = range_now(pair), distance = std::sqrt(d.squared());
  const Vec3 normal = distance > 0 ? Vec3(d.across / distance) : Vec3::Zero();
  const double stiffness = barrier(0.5 * range, range, options_.stiffness).stiffness;
  return {pair.key, pair.vertices, d.weights, {}, normal, distance, 0, stiffness};
}

/// Of the pairs [begin, end).
void ClothContact::find_touching(std::span<const ListedPair> pairs, std::span<const Vec3> x,
                                 std::size_t begin, std::size_t end, std::vector<Touching>& found) const {
  found.clear();
  Ranges ranges(special_, pairs[begin].key);
  each_four(pairs.subspan(begin, end - begin), [&](std::span<const ListedPair> four, bool edges) {
    const FourPairs at = four_of(four, lanes_.at);
    Float4 range = splat(0);
    for (std::size_t i = 0; i < four.size(); ++i) range[i] = float(four[i].range);
    const Separation apart = edges ? edge_edge_separation(at) : vertex_triangle_separation(at);
    const unsigned beyond = bits_of(apart.beyond(splat(1.000001f) * range));
    for (std::size_t i = 0; i < four.size(); ++i) {
      if (beyond >> i & 1u) continue;
      const PairDistance d = distance_of(four[i], x);
      const double squared = d.squared();
      if (!(squared < four[i].range * four[i].range)) continue;
      const double now = ranges.now(four[i]);
      if (std::sqrt(squared) < now) found.push_back({std::size_t(&four[i] - pairs.data()), now, d});
    }
  });
}

ActivePair ClothContact::answer(const ListedPair& pair, const Touching& touching,
                                std::span<const Vec3> x) const {
  const PairDistance& d = touching.distance;
  const double distance = std::sqrt(d.squared());
  const Barrier b = barrier(distance, touching.range, options_.stiffness);
  ActivePair found{pair.key, pair.vertices, d.weights, {}, Vec3::Zero(), distance, b.energy, b.stiffness};
  if (!(distance > 0)) return found;
  found.normal = d.across / distance;
  const std::array<Vec3, 4> at = corners_of(pair.vertices, x);
  found.curvature = pair_curvature(pair.key.edges, at, d.weights);
  ParallelShare share;
  if (pair.key.edges) {
    const Vec3 e1 = at[1] - at[0], e2 = at[3] - at[2];
    share = parallel_share(
        e1, e2,
        mesh_.rest_lengths[std::size_t(pair.key.first)] * mesh_.rest_lengths[std::size_t(pair.key.second)]);
    found.energy *= share.factor;
    found.stiffness *= share.factor;
  }
  found.push = share.factor * b.force;
  found.range = pair.range;
  for (std::size_t i = 0; i < 4; ++i) found.force[i] = share.factor * b.force * d.weights[i] * found.normal;
  const Vec3 first = b.energy * share.first, second = b.energy * share.second;
  if (share.factor < 1) {
    found.force[0] += first, found.force[1] -= first;
    found.force[2] += second, found.force[3] -= second;
  }
  return found;
}

/// Pairs are listed in the order of their keys, and so are those that touch.
void ClothContact::look(std::span<const Vec3> x, ThreadPool* pool) {
  const std::span<const ListedPair> pairs = near(x, {}, pool);
  if (!pairs.empty()) lanes_.assign(x, {}, x[std::size_t(pairs[0].vertices[0])]);
  touching_.resize(std::max(touching_.size(), chunks_of(pairs.size())));
  by_chunks(pairs.size(), pool, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    find_touching(pairs, x, begin, end, touching_[chunk]);
  });
  std::vector<std::size_t> first(chunks_of(pairs.size()) + 1, 0);
  for (std::size_t c = 0; c + 1 < first.size(); ++c) first[c + 1] = first[c] + touching_[c].size();
  active_.resize(first.back());
  by_chunks(pairs.size(), pool, [&](std::size_t chunk, std::size_t, std::size_t) {
    for (std::size_t i = 0; i < touching_[chunk].size(); ++i) {
      const Touching& t = touching_[chunk][i];
      active_[first[chunk] + i] = answer(pairs[t.listed], t, x);
    }
  });
  energy_ = 0;
  for (const ActivePair& p : active_) energy_ += p.energy;
  acted_ = acted_ || !active_.empty();
  friction_.look(x);
}

void ClothContact::add_forces(std::span<Vec3> force) const {
  for (const ActivePair& p : active_)
    for (std::size_t i = 0; i < 4; ++i) force[std::size_t(p.vertices[i])] += p.force[i];
  friction_.add_forces(force);
}

std::vector<std::array<int, 2>> ClothContact::couples() const {
  std::vector<std::array<int, 2>> found = needed_blocks();
  for (auto& [i, j] : found)
    if (i < j) std::swap(i, j);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

bool ClothContact::hold_new(const StageStart& start, std::span<const Vec3> x) {
  friction_.hold_new(active_, start.x);
  friction_.look(x);
  return false;
}

void ClothContact::set_anchors(std::span<const PairAnchor> anchors, std::span<const Vec3> x,
                               ThreadPool* pool) {
  look(x, pool);
  friction_.set_anchors(anchors, active_);
}

ClothContact::Memory ClothContact::memory() const {
  Memory memory{special_, {}, crossed_at_start_, friction_.anchors(), {}};
  for (std::size_t i = 0; i < loose_.size(); ++i)
    if (loose_[i]) memory.loose.push_back(int(i));
  return memory;
}

/// And what edges join them to.
std::vector<char> ClothContact::with_neighbours(std::vector<char> marked) const {
  const std::vector<char> core = marked;
  for (const auto& [a, b] : mesh_.edges) {
    if (core[std::size_t(a)]) marked[std::size_t(b)] = 1;
    if (core[std::size_t(b)]) marked[std::size_t(a)] = 1;
  }
  return marked;
}

void ClothContact::check(const Memory& memory) const {
  const char* const operation = "ClothContact";
  for (const auto* vertices : {&memory.loose, &memory.fresh})
    for (const int v : *vertices)
      if (v < 0 || std::size_t(v) >= loose_.size()) refuse(operation, "what it knows is of another cloth");
  const auto check = [&](const PairKey& key) {
    const std::size_t second = key.edges ? mesh_.edges.size() : mesh_.triangles.size(),
                      first = key.edges ? second : loose_.size();
    if (key.first < 0 || std::size_t(key.first) >= first || key.second < 0 ||
        std::size_t(key.second) >= second)
      refuse(operation, "what it knows is of another cloth");
  };
  for (const SpecialPair& p : memory.special) check(p.key);
  for (const PairAnchor& a : memory.friction) check(a.key);
}

void ClothContact::recall(const Memory& memory, std::span<const Vec3> x, ThreadPool* pool) {
  check(memory);
  std::vector<char> unknown(loose_.size(), 0);
  for (const int v : memory.fresh) unknown[std::size_t(v)] = 1;
  unknown = with_neighbours(std::move(unknown));
  std::vector<SpecialPair> known = memory.special, made = std::move(special_);
  for (SpecialPair& p : known) p.target = std::min(p.target, range_of(mesh_, p.key));
  for (SpecialPair& p : known) p.range = std::min(p.range, p.target);
  std::erase_if(made, [&](const SpecialPair& p) {
    const auto v = vertices_of(mesh_, p.key);
    return std::none_of(v.begin(), v.end(), [&](int i) { return unknown[std::size_t(i)] != 0; });
  });
  special_.clear();
  std::set_union(known.begin(), known.end(), made.begin(), made.end(), std::back_inserter(special_),
                 [](const SpecialPair& a, const SpecialPair& b) { return a.key < b.key; });
  for (std::size_t v = 0; v < loose_.size(); ++v) loose_[v] = char(loose_[v] && unknown[v]);
  for (const int v : memory.loose) loose_[std::size_t(v)] = 1;
  crossed_at_start_ =
      memory.fresh.empty() ? memory.crossed_at_start : std::max(crossed_at_start_, memory.crossed_at_start);
  if (options_.friction > 0) set_anchors(memory.friction, x, pool);
}

void ClothContact::forget_cuts() {
  braced_.clear();
  blocked_ = 0;
}

std::vector<std::array<int, 2>> ClothContact::needed_blocks() const {
  std::vector<std::array<int, 2>> couples;
  for (const auto* pairs : {&active_, &braced_})
    for (const ActivePair& p : *pairs)
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < i; ++j)
          if (p.weights[i] != 0 && p.weights[j] != 0) couples.push_back({p.vertices[i], p.vertices[j]});
  friction_.list_couples(couples);
  return couples;
}

bool ClothContact::misses_blocks(const FreeStiffness& stiffness) const {
  const std::vector<std::array<int, 2>> needed = needed_blocks();
  return std::any_of(needed.begin(), needed.end(),
                     [&](const auto& c) { return !stiffness.couples(c[0], c[1]); });
}

void ClothContact::couple(FreeStiffness& stiffness) const {
  if (misses_blocks(stiffness)) stiffness.couple(needed_blocks());
}

void ClothContact::add_stiffness(FreeStiffness& stiffness, SlipStiffness of_slip) const {
  for (const auto* pairs : {&active_, &braced_})
    for (const ActivePair& p : *pairs) {
      const auto block = [&](std::size_t i, std::size_t j) {
        Mat3 sum = (p.stiffness * p.weights[i] * p.weights[j]) * p.normal * p.normal.transpose();
        for (int r = 0; r < p.curvature.rows; ++r)
          sum += (0.5 * p.push) * p.curvature.row(r, i, p.weights, p.normal) *
                 p.curvature.row(r, j, p.weights, p.normal).transpose();
        return sum;
      };
      for (std::size_t i = 0; i < 4; ++i) {
        if (p.weights[i] == 0) continue;
        stiffness.add(p.vertices[i], block(i, i));
        for (std::size_t j = 0; j < i; ++j)
          if (p.weights[j] != 0) stiffness.add(p.vertices[i], p.vertices[j], block(i, j));
      }
    }
  friction_.add_stiffness(stiffness, of_slip);
}

double ClothContact::nearest() const {
  double least = std::numeric_limits<double>::infinity();
  for (const ActivePair& p : active_) least = std::min(least, p.distance);
  return least;
}

int ClothContact::exempt() const {
  return int(
      std::count_if(special_.begin(), special_.end(), [](const SpecialPair& p) { return p.range == 0; }));
}

}  // namespace furrow::physics
