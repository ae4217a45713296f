// SPDX-License-Identifier: MIT
#include "physics/pairs/pair_pushes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "physics/base/require.h"
#include "physics/pairs/pair_distance.h"

namespace furrow::physics {
namespace {

constexpr double less_than_half = 0.45;  // of a distance, that either side may go
constexpr double same_side_cosine = 0.5;
constexpr int most_guard_rounds = 20;  // then all is cut
constexpr double at_range = 1.001;     // ranges: who rests on cloth
constexpr double small_push = 0.002;   // of a range: no need of another sweep
constexpr double last_share = 0.05;    // of a range, in which nothing may close
constexpr double within_range = 0.99;  // where pairs rest whose pushes last

/// Of a pair's distance, for an impulse along it.
double mobility_of(const std::array<double, 4>& weights, const std::array<int, 4>& v,
                   std::span<const double> mobility) {
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) sum += weights[i] * weights[i] * mobility[std::size_t(v[i])];
  return sum;
}

/// The sum of what a pair's vertices have, by its weights.
Vec3 sum_by_weight(const std::array<double, 4>& weights, const std::array<int, 4>& v,
                   std::span<const Vec3> of) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < 4; ++i) sum += weights[i] * of[std::size_t(v[i])];
  return sum;
}

/// As a pair lies: along which it is pushed apart, and how far it is apart in that direction.
struct Facing {
  Vec3 normal;  ///< zero: it touches
  std::array<double, 4> weights;
  double gap;  ///< [m]; less than 0: it went through
};

/// Where it is now, unless the step turned its normal; then as it was before.
Facing facing(const ClothContact::Met& pair, std::span<const Vec3> x) {
  const double before = std::sqrt(pair.before.squared());
  const PairDistance now = distance_of(pair.key.edges == 1, corners_of(pair.vertices, x));
  const double distance = std::sqrt(now.squared());
  const Vec3 n0 = before > 0 ? Vec3(pair.before.across / before) : Vec3::Zero();
  if (distance > 0 && now.across.dot(n0) > same_side_cosine * distance)
    return {now.across / distance, now.weights, distance};
  return {n0, pair.before.weights, n0.dot(sum_by_weight(pair.before.weights, pair.vertices, x))};
}

const Cloth& checked(const Cloth& cloth, const PairPushOptions& options) {
  const char* const me = "contact of the cloth with itself";
  require(me, "thickness", options.thickness, options.thickness > 0, "> 0");
  require(me, "friction", options.friction, options.friction >= 0, ">= 0");
  if (cloth.triangles.empty()) refuse(me, "it needs the cloth's triangles (Cloth::triangles)");
  return cloth;
}

ClothContactOptions contact_options(const PairPushOptions& o) {
  ClothContactOptions options;
  options.thickness = o.thickness;
  options.thicknesses = o.thicknesses;
  options.groups = o.groups;
  return options;
}

}  // namespace

PairPushes::PairPushes(const Cloth& cloth, std::span<const Vec3> x, const PairPushOptions& options,
                       ThreadPool* pool)
    : friction_(options.friction),
      lasting_(options.lasting),
      contact_(checked(cloth, options), contact_options(options), x, options.drawn, pool),
      least_radius_(contact_.mesh().radius),
      touched_(x.size(), 0),
      bounded_(x.size(), 0),
      room_(x.size(), 0) {
  const PairMesh& mesh = contact_.mesh();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const int v : mesh.triangles[t])
      least_radius_[std::size_t(v)] = std::min(least_radius_[std::size_t(v)], mesh.triangle_radius[t]);
}

void PairPushes::note_ways(std::span<const Vec3> x) {
  way_.resize(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) way_[i] = x[i] - x0_[i];
}

/// Of pairs that are met again; both are sorted by key.
void PairPushes::take_last(const std::vector<ClothContact::Met>& met, const std::vector<Push>& pushes) {
  for (std::size_t i = 0, k = 0; i < met_.size() && k < met.size(); ++i) {
    while (k < met.size() && met[k].key < met_[i].key) ++k;
    if (k < met.size() && met[k].key == met_[i].key) pushes_[i] = pushes[k];
  }
}

bool PairPushes::begin_step(std::span<const Vec3> x0, std::span<const Vec3> x, ThreadPool* pool) {
  for (const int v : touched_list_) touched_[std::size_t(v)] = 0;
  touched_list_.clear();
  x0_ = x0;
  note_ways(x);
  const std::vector<ClothContact::Met>& met = contact_.meet(x0_, way_, pool);
  if (!lasting_) {
    met_ = met;
    pushes_.assign(met_.size(), {});
    return !met_.empty();
  }
  const std::vector<ClothContact::Met> last = std::exchange(met_, met);
  const std::vector<Push> pushes = std::exchange(pushes_, std::vector<Push>(met.size()));
  take_last(last, pushes);
  return !met_.empty();
}

void PairPushes::touch(const std::array<int, 4>& vertices) {
  for (const int v : vertices) {
    if (touched_[std::size_t(v)]) continue;
    touched_[std::size_t(v)] = 1;
    touched_list_.push_back(v);
  }
}

/// Where it comes to rest [m].
double PairPushes::rest_gap(const ClothContact::Met& pair) const {
  return lasting_ ? within_range * pair.range : pair.range;
}

/// One step of projected Gauss-Seidel: what all sweeps pushed a pair is no pull, and its friction is within
/// that times the coefficient. Returns by how much the push changed.
double PairPushes::push_apart(const ClothContact::Met& pair, Push& push, std::span<Vec3> x,
                              std::span<const double> mobility) {
  const Facing now = facing(pair, x);
  const double before = push.along;
  const double least = std::min(rest_gap(pair), std::sqrt(pair.before.squared()));
  push.along = std::max(0.0, before + least - now.gap);
  const double change = push.along - before, sum = mobility_of(now.weights, pair.vertices, mobility);
  if (!(sum > 0) || (change == 0 && push.along == 0)) return 0;
  const auto move = [&](const Vec3& by) {
    for (std::size_t i = 0; i < 4; ++i) {
      const auto v = std::size_t(pair.vertices[i]);
      x[v] += now.weights[i] * mobility[v] / sum * by;
    }
  };
  move(change * now.normal);
  touch(pair.vertices);
  if (friction_ > 0) {
    const Vec3 way =
        sum_by_weight(now.weights, pair.vertices, x) - sum_by_weight(now.weights, pair.vertices, x0_);
    const Vec3 wanted = push.across - (way - now.normal.dot(way) * now.normal);
    const double most = friction_ * push.along, length = wanted.norm();
    const Vec3 across = length <= most ? wanted : Vec3(most / length * wanted);
    move(across - push.across);
    push.across = across;
  }
  return std::abs(change);
}

bool PairPushes::sweep(std::span<Vec3> x, std::span<const double> mobility) {
  bool again = false;
  for (std::size_t i = 0; i < met_.size(); ++i)
    again = push_apart(met_[i], pushes_[i], x, mobility) > small_push * met_[i].range || again;
  return again;
}

std::vector<PairPushes::Deep> PairPushes::deep(std::span<const Vec3> x,
                                               std::span<const double> mobility) const {
  std::vector<Deep> found;
  for (const ClothContact::Met& pair : met_) {
    if (!(pair.before.squared() < pair.range * pair.range)) continue;
    const Facing now = facing(pair, x);
    const double sum = mobility_of(now.weights, pair.vertices, mobility), depth = pair.range - now.gap;
    if (depth > 0 && sum > 0) found.push_back({pair.vertices, now.weights, now.normal, depth, sum});
  }
  return found;
}

double PairPushes::recover(std::span<Vec3> x, std::span<const double> mobility, double share) {
  double most = 0;
  for (const ClothContact::Met& pair : met_) {
    const Facing now = facing(pair, x);
    const double sum = mobility_of(now.weights, pair.vertices, mobility), missing = rest_gap(pair) - now.gap;
    if (!(missing > 0) || !(sum > 0)) continue;
    most = std::max(most, missing / pair.range);
    for (std::size_t i = 0; i < 4; ++i) {
      const auto v = std::size_t(pair.vertices[i]);
      x[v] += share * missing / sum * now.weights[i] * mobility[v] * now.normal;
    }
    touch(pair.vertices);
  }
  return most;
}

void PairPushes::add_reactions(std::span<const Vec3> x, std::span<const double> mobility, double scale,
                               std::span<Vec3> force) {
  for (std::size_t i = 0; i < met_.size(); ++i) {
    if (!(pushes_[i].along > 0)) continue;
    const Facing now = facing(met_[i], x);
    const double sum = mobility_of(now.weights, met_[i].vertices, mobility);
    if (!(sum > 0) || now.gap > at_range * met_[i].range) {
      pushes_[i] = {};
      continue;
    }
    const Vec3 reaction = scale / sum * (pushes_[i].along * now.normal + pushes_[i].across);
    for (std::size_t k = 0; k < 4; ++k) force[std::size_t(met_[i].vertices[k])] += now.weights[k] * reaction;
  }
}

PairPushes::Touching PairPushes::touching(std::span<const Vec3> x) const {
  Touching touching;
  touching.nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < met_.size(); ++i) {
    const ClothContact::Met& p = met_[i];
    const double distance = std::sqrt(distance_of(p.key.edges == 1, corners_of(p.vertices, x)).squared());
    touching.nearest = std::min(touching.nearest, distance);
    if (!(distance <= at_range * p.range)) continue;
    ++touching.pairs;
    const double most = friction_ * pushes_[i].along;
    touching.sliding += most > 0 && pushes_[i].across.norm() > (1 - 1e-9) * most;
  }
  return touching;
}

/// Whether the guard has nothing to look at: no move was changed, and all are free.
bool PairPushes::is_clear() const {
  return touched_list_.empty() && std::all_of(met_.begin(), met_.end(), [](const auto& pair) {
           return pair.share == 1 && !(pair.before.squared() < pair.range * pair.range);
         });
}

bool PairPushes::closes_in(const ClothContact::Met& pair) const {
  std::array<Vec3, 4> end = corners_of(pair.vertices, x0_);
  const std::array<Vec3, 4> way = corners_of(pair.vertices, way_);
  for (std::size_t i = 0; i < 4; ++i) end[i] += way[i];
  const double after = distance_of(pair.key.edges == 1, end).squared(), least = last_share * pair.range;
  return after < least * least && after < pair.before.squared();
}

/// Bounds the vertices of pairs whose way is not free; whether there are any that were not. A bounded vertex
/// may go less than half of its distance to what is near, and of the thickness, in which nothing else is.
bool PairPushes::bound(const std::vector<ClothContact::Met>& pairs) {
  bool more = false;
  for (const ClothContact::Met& pair : pairs) {
    if (pair.share == 1 && !closes_in(pair)) continue;
    for (const int v : pair.vertices) {
      more = more || !bounded_[std::size_t(v)];
      bounded_[std::size_t(v)] = 1;
    }
  }
  if (!more) return false;
  for (std::size_t i = 0; i < room_.size(); ++i) room_[i] = 2 * less_than_half * least_radius_[i];
  for (const ClothContact::Met& pair : pairs) {
    const double least = 0.5 * last_share * pair.range;
    const double room = less_than_half * std::max(0.0, std::sqrt(pair.before.squared()) - least);
    for (const int v : pair.vertices) room_[std::size_t(v)] = std::min(room_[std::size_t(v)], room);
  }
  return true;
}

/// The ways of bounded vertices, beside what all have in common.
void PairPushes::cut(std::span<const Vec3> x, const Vec3& common) {
  for (std::size_t i = 0; i < way_.size(); ++i) {
    if (!bounded_[i]) continue;
    const Vec3 own = x[i] - x0_[i] - common;
    const double length = own.norm();
    way_[i] = common + (length <= room_[i] ? own : Vec3(room_[i] / length * own));
  }
}

Vec3 PairPushes::common_way(std::span<const double> mobility) const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < way_.size(); ++i) {
    if (mobility[i] == 0) return Vec3::Zero();
    sum += way_[i];
  }
  return sum / double(way_.size());
}

const std::vector<int>& PairPushes::guard(std::span<Vec3> x, std::span<const double> mobility,
                                          ThreadPool* pool) {
  cut_list_.clear();
  if (met_.empty() || is_clear()) return cut_list_;
  note_ways(x);
  bool any = false;
  Vec3 common = Vec3::Zero();
  for (int round = 0; bound(contact_.meet(x0_, way_, pool)); ++round) {
    if (!any) common = common_way(mobility);
    any = true;
    if (round == most_guard_rounds) std::fill(bounded_.begin(), bounded_.end(), 1);
    cut(x, common);
  }
  if (!any) return cut_list_;
  for (std::size_t i = 0; i < way_.size(); ++i) {
    const Vec3 wanted = x[i], reached = x0_[i] + way_[i];
    if (bounded_[i] && (reached - wanted).norm() > 1e-12 * (1 + wanted.norm())) {
      cut_list_.push_back(int(i));
      x[i] = reached;
    }
    bounded_[i] = 0;
  }
  return cut_list_;
}

}  // namespace furrow::physics
