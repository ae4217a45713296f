// SPDX-License-Identifier: MIT
#include "physics/motion/pair_response.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/base/require.h"
#include "physics/motion/pair_memory.h"
#include "physics/motion/step_elements.h"
#include "physics/motion/stepper.h"
#include "physics/pairs/pair_distance.h"

namespace furrow::physics {
namespace {

constexpr double less_than_half = 0.45;     // of a distance, that either side may go
constexpr double same_side = 0.5;           // cosine: two normals that agree
constexpr int most_rounds = 20;             // of the guard; then all is cut
constexpr double as_touching = 1.001;       // ranges: who rests on cloth
constexpr double stiffness_of_depth = 0.3;  // of mass over dt^2
constexpr double recovery_steps = 4;        // in which depth may go at the soonest
constexpr double small_push = 0.002;        // of a range: no need of another sweep
constexpr double last_share = 0.05;         // of a range, in which nothing may close

void put(const Vec3& v, Vec4& to) { to = {v.x(), v.y(), v.z(), 0}; }

/// Of a pair's distance, for an impulse along it [1/kg].
double mobility(const std::array<double, 4>& weights, const std::array<int, 4>& v,
                const std::vector<double>& inv_mass) {
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) sum += weights[i] * weights[i] * inv_mass[std::size_t(v[i])];
  return sum;
}

/// The sum of what a pair's vertices have, by its weights.
Vec3 weighted(const std::array<double, 4>& weights, const std::array<int, 4>& v, std::span<const Vec3> of) {
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
  if (distance > 0 && now.across.dot(n0) > same_side * distance)
    return {now.across / distance, now.weights, distance};
  return {n0, pair.before.weights, n0.dot(weighted(pair.before.weights, pair.vertices, x))};
}

}  // namespace

PairResponse::PairResponse(const SelfContactOptions& options) : options_(options) {
  const char* const me = "contact of the cloth with itself";
  require(me, "thickness", options.thickness, options.thickness > 0, "> 0");
  require(me, "friction", options.friction, options.friction >= 0, ">= 0");
}

void PairResponse::attach(const PackedCloth& packed, std::span<const int> led, ThreadPool& pool) {
  const Cloth cloth = with_free_leads(cloth_by_place(packed), led);
  if (cloth.triangles.empty())
    refuse("contact of the cloth with itself", "it needs the cloth's triangles (Cloth::triangles)");
  contact_ = std::make_unique<ClothContact>(cloth, ClothContactOptions{options_.thickness}, cloth.particles.x,
                                            std::span<const Vec3>{}, &pool);
  const PairMesh& mesh = contact_->mesh();
  least_radius_ = mesh.radius;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const int v : mesh.triangles[t])
      least_radius_[std::size_t(v)] = std::min(least_radius_[std::size_t(v)], mesh.triangle_radius[t]);
  const std::size_t n = packed.x.size();
  touched_.assign(n, 0);
  bounded_.assign(n, 0);
  room_.assign(n, 0);
}

void PairResponse::note_ways(std::span<const Vec4> x0, const PackedCloth& cloth) {
  const std::size_t n = x0.size();
  x0_.resize(n);
  x_.resize(n);
  way_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    x0_[i] = xyz(x0[i]);
    x_[i] = xyz(cloth.x[i]);
    way_[i] = x_[i] - x0_[i];
  }
}

void PairResponse::touch(const std::array<int, 4>& vertices) {
  for (const int v : vertices) {
    if (touched_[std::size_t(v)]) continue;
    touched_[std::size_t(v)] = 1;
    places_.push_back(v);
  }
}

/// One step of projected Gauss-Seidel: what all sweeps pushed a pair is no pull, and its friction is within
/// that times the coefficient. Returns by how much the push changed.
double PairResponse::push_apart(const ClothContact::Met& pair, Push& push,
                                const std::vector<double>& inv_mass) {
  const Facing now = facing(pair, x_);
  const double before = push.along;
  push.along = std::max(0.0, before + std::min(pair.range, std::sqrt(pair.before.squared())) - now.gap);
  const double change = push.along - before, sum = mobility(now.weights, pair.vertices, inv_mass);
  if (!(sum > 0) || (change == 0 && push.along == 0)) return 0;
  const auto move = [&](const Vec3& by) {
    for (std::size_t i = 0; i < 4; ++i) {
      const auto v = std::size_t(pair.vertices[i]);
      x_[v] += now.weights[i] * inv_mass[v] / sum * by;
    }
  };
  move(change * now.normal);
  touch(pair.vertices);
  if (options_.friction > 0) {
    const Vec3 way = weighted(now.weights, pair.vertices, x_) - weighted(now.weights, pair.vertices, x0_);
    const Vec3 wanted = push.across - (way - now.normal.dot(way) * now.normal);
    const double most = options_.friction * push.along, length = wanted.norm();
    const Vec3 across = length <= most ? wanted : Vec3(most / length * wanted);
    move(across - push.across);
    push.across = across;
  }
  return std::abs(change);
}

bool PairResponse::begin_step(std::span<const Vec4> x0, const PackedCloth& cloth, ThreadPool& pool) {
  for (const int v : places_) touched_[std::size_t(v)] = 0;
  places_.clear();
  note_ways(x0, cloth);
  met_ = contact_->meet(x0_, way_, &pool);
  pushes_.assign(met_.size(), {});
  return !met_.empty();
}

bool PairResponse::sweep(double dt, PackedCloth& cloth) {
  for (const int v : places_) x_[std::size_t(v)] = xyz(cloth.x[std::size_t(v)]);
  bool again = false;
  for (std::size_t i = 0; i < met_.size(); ++i)
    again = push_apart(met_[i], pushes_[i], cloth.inv_mass) > small_push * met_[i].range || again;
  for (const int v : places_) {
    const auto i = std::size_t(v);
    if (cloth.inv_mass[i] == 0) continue;
    put(xyz(cloth.v[i]) + (x_[i] - xyz(cloth.x[i])) / dt, cloth.v[i]);
    put(x_[i], cloth.x[i]);
  }
  return again;
}

/// Gives what is nearer than its range a speed apart, by a push that grows with the depth: so pressed layers
/// bear a load, and cloth that is caught in itself is not stretched without bound.
void PairResponse::take_out(double dt, PackedCloth& cloth) {
  for (const ClothContact::Met& pair : met_) {
    if (!(pair.before.squared() < pair.range * pair.range)) continue;
    for (const int v : pair.vertices) x_[std::size_t(v)] = xyz(cloth.x[std::size_t(v)]);
    const Facing now = facing(pair, x_);
    const double sum = mobility(now.weights, pair.vertices, cloth.inv_mass), depth = pair.range - now.gap;
    if (!(depth > 0) || !(sum > 0)) continue;
    double speed = 0;
    for (std::size_t i = 0; i < 4; ++i)
      speed += now.weights[i] * now.normal.dot(xyz(cloth.v[std::size_t(pair.vertices[i])]));
    const double wanted = depth / (recovery_steps * dt) - speed;
    const double change = std::min(wanted, stiffness_of_depth * depth / dt);
    if (!(change > 0)) continue;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto v = std::size_t(pair.vertices[i]);
      put(xyz(cloth.v[v]) + change / sum * now.weights[i] * cloth.inv_mass[v] * now.normal, cloth.v[v]);
    }
  }
}

void PairResponse::finish_step(std::span<const Vec4> x0, double dt, PackedCloth& cloth, ThreadPool& pool) {
  if (met_.empty()) return;
  take_out(dt, cloth);
  const bool clear = places_.empty() && std::all_of(met_.begin(), met_.end(), [](const auto& pair) {
                       return pair.share == 1 && !(pair.before.squared() < pair.range * pair.range);
                     });
  if (!clear) guard(x0, dt, cloth, pool);
}

bool PairResponse::closes_in(const ClothContact::Met& pair) const {
  std::array<Vec3, 4> end = corners_of(pair.vertices, x0_);
  const std::array<Vec3, 4> way = corners_of(pair.vertices, way_);
  for (std::size_t i = 0; i < 4; ++i) end[i] += way[i];
  const double after = distance_of(pair.key.edges == 1, end).squared(), least = last_share * pair.range;
  return after < least * least && after < pair.before.squared();
}

/// Bounds the vertices of pairs whose way is not free; whether there are any that were not. A bounded vertex
/// may go less than half of its distance to what is near, and of the thickness, in which nothing else is.
bool PairResponse::bound(const std::vector<ClothContact::Met>& pairs) {
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
void PairResponse::cut(const PackedCloth& cloth, const Vec3& common) {
  for (std::size_t i = 0; i < way_.size(); ++i) {
    if (!bounded_[i]) continue;
    const Vec3 own = xyz(cloth.x[i]) - x0_[i] - common;
    const double length = own.norm();
    way_[i] = common + (length <= room_[i] ? own : Vec3(room_[i] / length * own));
  }
}

Vec3 PairResponse::common_way(const PackedCloth& cloth) const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < way_.size(); ++i) {
    if (cloth.inv_mass[i] == 0) return Vec3::Zero();
    sum += way_[i];
  }
  return sum / double(way_.size());
}

void PairResponse::guard(std::span<const Vec4> x0, double dt, PackedCloth& cloth, ThreadPool& pool) {
  note_ways(x0, cloth);
  bool any = false;
  Vec3 common = Vec3::Zero();
  for (int round = 0; bound(contact_->meet(x0_, way_, &pool)); ++round) {
    if (!any) common = common_way(cloth);
    any = true;
    if (round == most_rounds) std::fill(bounded_.begin(), bounded_.end(), 1);
    cut(cloth, common);
  }
  if (!any) return;
  for (std::size_t i = 0; i < way_.size(); ++i) {
    const Vec3 wanted = xyz(cloth.x[i]), reached = x0_[i] + way_[i];
    const bool is_cut = bounded_[i] && (reached - wanted).norm() > 1e-12 * (1 + wanted.norm());
    bounded_[i] = 0;
    if (!is_cut) continue;
    ++cut_moves_;
    if (cloth.inv_mass[i] == 0) {
      std::copy(x0.begin(), x0.end(), cloth.x.begin());
      std::fill(bounded_.begin(), bounded_.end(), 0);
      throw StepBlocked(x0_[i]);
    }
    put(xyz(cloth.v[i]) + (reached - wanted) / dt, cloth.v[i]);
    put(reached, cloth.x[i]);
  }
}

void PairResponse::widen(const PackedCloth& cloth) {
  std::vector<Vec3> x;
  for (const Vec4& p : cloth.x) x.push_back(xyz(p));
  contact_->widen(x);
}

SelfContactMemory PairResponse::memory() const { return memory_of(*contact_, 1); }

void PairResponse::recall(const SelfContactMemory& known) { recall_pairs(known, {}, *contact_, nullptr); }

SelfContactState PairResponse::state(const PackedCloth& cloth) const {
  std::vector<Vec3> x;
  for (const Vec4& p : cloth.x) x.push_back(xyz(p));
  SelfContactState state;
  state.on = true;
  double nearest = std::numeric_limits<double>::infinity();
  for (const ClothContact::Met& p : met_) {
    const double distance = std::sqrt(distance_of(p.key.edges == 1, corners_of(p.vertices, x)).squared());
    nearest = std::min(nearest, distance);
    state.pairs += distance <= as_touching * p.range;
  }
  if (state.pairs > 0) state.nearest = nearest;
  state.crossed_at_start = contact_->crossed_at_start();
  state.exempt = contact_->exempt();
  return state;
}

}  // namespace furrow::physics
