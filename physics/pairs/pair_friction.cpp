// SPDX-License-Identifier: MIT
#include "physics/pairs/pair_friction.h"

#include <algorithm>
#include <cmath>

#include "physics/base/require.h"

namespace furrow::physics {
namespace {

constexpr double slip_of_range = 1.0 / 30;

Vec3 in_plane(const Vec3& way, const Vec3& normal) { return way - normal.dot(way) * normal; }

/// The way of the first primitive against the second.
Vec3 across(const std::array<int, 4>& vertices, const std::array<double, 4>& weights,
            std::span<const Vec3> x) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < 4; ++i) sum += weights[i] * x[std::size_t(vertices[i])];
  return sum;
}

}  // namespace

PairFriction::PairFriction(double coefficient) : coefficient_(coefficient) {
  require("PairFriction", "friction", coefficient, coefficient >= 0, ">= 0");
}

/// Sorted by vertex.
std::vector<PairFriction::Share> PairFriction::shares() const {
  std::vector<Share> list;
  for (const Pair& p : pairs_) {
    if (!(p.limit > 0)) continue;
    const double length = p.way.norm();
    const Vec3 way = length > p.slip ? Vec3(p.slip / length * p.way) : p.way;
    for (std::size_t i = 0; i < 4; ++i) {
      const double w = p.weights[i], side = w < 0 ? -1 : 1;
      if (w != 0) list.push_back({p.vertices[i], side * p.normal, side * way, p.limit * std::abs(w)});
    }
  }
  std::stable_sort(list.begin(), list.end(),
                   [](const Share& a, const Share& b) { return a.vertex < b.vertex; });
  return list;
}

/// The mean way of the pair's vertices on this side of the cloth [m]; 0 where they had none.
Vec3 PairFriction::inherited(const ActivePair& pair, std::span<const Share> shares) {
  Vec3 sum = Vec3::Zero();
  double known = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double w = pair.weights[i], side = w < 0 ? -1 : 1;
    if (w == 0) continue;
    const auto first = std::lower_bound(shares.begin(), shares.end(), pair.vertices[i],
                                        [](const Share& s, int vertex) { return s.vertex < vertex; });
    Vec3 way = Vec3::Zero();
    double weight = 0;
    for (auto s = first; s != shares.end() && s->vertex == pair.vertices[i]; ++s) {
      const double alike = side * s->normal.dot(pair.normal);
      if (!(alike > 0)) continue;
      way += alike * s->weight * s->way;
      weight += alike * s->weight;
    }
    if (!(weight > 0)) continue;
    sum += w / weight * way;
    known += std::abs(w);
  }
  return known > 0 ? Vec3(sum / known) : Vec3::Zero();
}

PairFriction::Pair PairFriction::held(const ActivePair& p, const Vec3& tether, bool slides,
                                      const Vec3& way) const {
  const double slip = slip_of_range * p.range;
  return {p.key, p.vertices, p.weights, p.normal, tether, coefficient_ * p.push, slip, slides, way};
}

void PairFriction::hold_new(std::span<const ActivePair> active, std::span<const Vec3> from) {
  if (active.empty() || coefficient_ == 0) return;
  look(from);
  const std::vector<Share> before = shares();
  const std::vector<Pair> known = std::move(pairs_);
  pairs_.clear();
  auto old = known.begin();
  for (const ActivePair& p : active) {
    for (; old != known.end() && old->key < p.key; ++old) pairs_.push_back(*old);
    if (!(p.push > 0) || (old != known.end() && old->key == p.key)) continue;
    const Vec3 way = in_plane(inherited(p, before), p.normal);
    pairs_.push_back(held(p, way - in_plane(across(p.vertices, p.weights, from), p.normal), false, way));
  }
  pairs_.insert(pairs_.end(), old, known.end());
  sum_energy();
}

std::vector<PairAnchor> PairFriction::anchors() const {
  std::vector<PairAnchor> found;
  for (const Pair& p : pairs_) found.push_back({p.key, p.tether, p.slides});
  return found;
}

void PairFriction::set_anchors(std::span<const PairAnchor> anchors, std::span<const ActivePair> active) {
  pairs_.clear();
  auto p = active.begin();
  for (const PairAnchor& a : anchors) {
    while (p != active.end() && p->key < a.key) ++p;
    if (p != active.end() && p->key == a.key && p->push > 0)
      pairs_.push_back(held(*p, a.tether, a.slides, a.tether));
  }
  sum_energy();
}

void PairFriction::move_anchors(std::span<const ActivePair> active, std::span<const Vec3> x) {
  if (active.empty() || coefficient_ == 0) {
    pairs_.clear();
    energy_ = 0;
    return;
  }
  const std::vector<Share> before = shares();
  std::vector<Pair> now;
  auto old = pairs_.begin();
  for (const ActivePair& p : active) {
    if (!(p.push > 0)) continue;
    while (old != pairs_.end() && old->key < p.key) ++old;
    const bool known = old != pairs_.end() && old->key == p.key;
    const Vec3 way = in_plane(known ? old->way : inherited(p, before), p.normal);
    const double slip = slip_of_range * p.range, length = way.norm();
    const bool slides = length > slip;
    const Vec3 kept = slides ? Vec3(slip / length * way) : way;
    const Vec3 here = in_plane(across(p.vertices, p.weights, x), p.normal);
    now.push_back(held(p, kept - here, slides, kept));
  }
  pairs_ = std::move(now);
  sum_energy();
}

void PairFriction::expect(std::span<const ActivePair> active, std::span<const Vec3> move) {
  auto p = active.begin();
  for (Pair& f : pairs_) {
    while (p != active.end() && p->key < f.key) ++p;
    const bool pushed = p != active.end() && p->key == f.key;
    const double nearer = pushed ? -p->normal.dot(across(p->vertices, p->weights, move)) : 0;
    f.limit = pushed ? coefficient_ * std::max(0.0, p->push + p->stiffness * nearer) : 0;
  }
  sum_energy();
}

void PairFriction::look(std::span<const Vec3> x) {
  for (Pair& p : pairs_) p.way = in_plane(across(p.vertices, p.weights, x), p.normal) + p.tether;
  sum_energy();
}

void PairFriction::sum_energy() {
  energy_ = 0;
  for (const Pair& p : pairs_) {
    const double u = p.way.norm();
    energy_ += p.limit * (u <= p.slip ? 0.5 * u * u / p.slip : u - 0.5 * p.slip);
  }
}

void PairFriction::add_forces(std::span<Vec3> force) const {
  for (const Pair& p : pairs_) {
    const Vec3 back = -p.limit / std::max(p.slip, p.way.norm()) * p.way;
    for (std::size_t i = 0; i < 4; ++i) force[std::size_t(p.vertices[i])] += p.weights[i] * back;
  }
}

void PairFriction::add_stiffness(FreeStiffness& stiffness, SlipStiffness of_slip) const {
  for (const Pair& p : pairs_) {
    const double length = p.way.norm();
    Mat3 along = Mat3::Identity() - p.normal * p.normal.transpose();
    // What slides goes on sliding: nothing holds it back along its way.
    const bool slides = length > p.slip || (p.slides && length > 0);
    if (slides && of_slip == SlipStiffness::none) along -= p.way * p.way.transpose() / (length * length);
    const Mat3 block = p.limit / std::max(p.slip, length) * along;
    for (std::size_t i = 0; i < 4; ++i) {
      stiffness.add(p.vertices[i], p.weights[i] * p.weights[i] * block);
      for (std::size_t j = 0; j < i; ++j)
        if (p.weights[i] * p.weights[j] != 0)
          stiffness.add(p.vertices[i], p.vertices[j], p.weights[i] * p.weights[j] * block);
    }
  }
}

void PairFriction::list_couples(std::vector<std::array<int, 2>>& couples) const {
  for (const Pair& p : pairs_)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (p.weights[i] * p.weights[j] != 0) couples.push_back({p.vertices[i], p.vertices[j]});
}

int PairFriction::sliding() const {
  return int(std::count_if(pairs_.begin(), pairs_.end(), [](const Pair& p) { return p.slides; }));
}

}  // namespace furrow::physics
