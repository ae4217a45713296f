// SPDX-License-Identifier: MIT
#include "physics/motion/pair_response.h"

#include <algorithm>

#include "physics/base/require.h"
#include "physics/motion/pair_memory.h"
#include "physics/motion/step_elements.h"
#include "physics/motion/stepper.h"

namespace furrow::physics {
namespace {

constexpr double stiffness_of_depth = 0.3;  // of mass over dt^2
constexpr double recovery_steps = 4;        // in which depth may go at the soonest

void put(const Vec3& v, Vec4& to) { to = {v.x(), v.y(), v.z(), 0}; }

void copy_to(std::vector<Vec3>& to, std::span<const Vec4> from) {
  to.resize(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) to[i] = xyz(from[i]);
}

}  // namespace

PairResponse::PairResponse(const SelfContactOptions& options) : options_(options) {
  const char* const me = "contact of the cloth with itself";
  require(me, "thickness", options.thickness, options.thickness > 0, "> 0");
  require(me, "friction", options.friction, options.friction >= 0, ">= 0");
}

void PairResponse::attach(const PackedCloth& packed, std::span<const int> led, ThreadPool& pool) {
  const Cloth cloth = with_free_leads(cloth_by_place(packed), led);
  PairPushOptions options;
  options.thickness = options_.thickness;
  options.friction = options_.friction;
  pushes_ = std::make_unique<PairPushes>(cloth, cloth.particles.x, options, &pool);
}

bool PairResponse::begin_step(std::span<const Vec4> x0, const PackedCloth& cloth, ThreadPool& pool) {
  copy_to(x0_, x0);
  copy_to(x_, cloth.x);
  return pushes_->begin_step(x0_, x_, &pool);
}

void PairResponse::take_touched(const PackedCloth& cloth) {
  for (const int v : touched()) x_[std::size_t(v)] = xyz(cloth.x[std::size_t(v)]);
}

bool PairResponse::sweep(double dt, PackedCloth& cloth) {
  take_touched(cloth);
  const bool again = pushes_->sweep(x_, cloth.inv_mass);
  for (const int v : touched()) {
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
  for (const PairPushes::Deep& deep : pushes_->deep(x_, cloth.inv_mass)) {
    double speed = 0;
    for (std::size_t i = 0; i < 4; ++i)
      speed += deep.weights[i] * deep.normal.dot(xyz(cloth.v[std::size_t(deep.vertices[i])]));
    const double wanted = deep.depth / (recovery_steps * dt) - speed;
    const double change = std::min(wanted, stiffness_of_depth * deep.depth / dt);
    if (!(change > 0)) continue;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto v = std::size_t(deep.vertices[i]);
      put(xyz(cloth.v[v]) + change / deep.mobility * deep.weights[i] * cloth.inv_mass[v] * deep.normal,
          cloth.v[v]);
    }
  }
}

void PairResponse::finish_step(std::span<const Vec4> x0, double dt, PackedCloth& cloth, ThreadPool& pool) {
  take_touched(cloth);
  take_out(dt, cloth);
  for (const int v : pushes_->guard(x_, cloth.inv_mass, &pool)) {
    const auto i = std::size_t(v);
    ++cut_moves_;
    if (cloth.inv_mass[i] == 0) {
      std::copy(x0.begin(), x0.end(), cloth.x.begin());
      throw StepBlocked(x0_[i]);
    }
    put(xyz(cloth.v[i]) + (x_[i] - xyz(cloth.x[i])) / dt, cloth.v[i]);
    put(x_[i], cloth.x[i]);
  }
}

void PairResponse::widen(const PackedCloth& cloth) {
  std::vector<Vec3> x;
  copy_to(x, cloth.x);
  pushes_->contact().widen(x);
}

SelfContactMemory PairResponse::memory(const PackedCloth& cloth) const {
  return memory_of(pushes_->contact(), 1, cloth.particle);
}

void PairResponse::recall(const StepMemory& known, const PackedCloth& cloth) {
  recall_pairs(known.self, known.fresh, cloth.particle, {}, pushes_->contact(), nullptr);
}

SelfContactState PairResponse::state(const PackedCloth& cloth) const {
  std::vector<Vec3> x;
  copy_to(x, cloth.x);
  SelfContactState state;
  state.on = true;
  const PairPushes::Touching touching = pushes_->touching(x);
  state.pairs = touching.pairs;
  if (state.pairs > 0) state.nearest = touching.nearest;
  state.crossed_at_start = pushes_->contact().crossed_at_start();
  state.exempt = pushes_->contact().exempt();
  return state;
}

}  // namespace furrow::physics
