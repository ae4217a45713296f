// SPDX-License-Identifier: MIT
#pragma once
#include "physics/motion/simulate.h"

namespace furrow::physics {

// The register of what a state knows of single particles. Each struct is taken apart into all its members, so
// that one that is added does not compile before it has its place here.

/// What becomes of an array of a state when the cloth gets more particles and others lie elsewhere.
enum class Carried {
  in_place,  ///< a particle that has stayed where it was keeps its entry, all others have none yet
  always,    ///< particles keep theirs, new ones have 0
  never      ///< the array becomes empty
};

/// visit(what, array, carried) of each array that has one entry a particle, or is empty.
template <class State, class Visit>
void for_each_particle_array(State& state, const Visit& visit) {
  auto& [time, step, planned, end, dt, dt_longest, steps_left, estimated_at, dt_limit, strain, cloth, contact,
         steps, body_travel, homes, compensation, totals] = state;
  auto& [anchors, acceleration, contact_stiffness, self, fresh] = steps;
  auto& [force, start, time_constant] = compensation;
  visit("contact memories", contact, Carried::in_place);
  visit("compensating forces", force, Carried::always);
  visit("anchors of friction", anchors, Carried::in_place);
  visit("accelerations", acceleration, Carried::never);  // forces jump: as at the beginning
}

/// visit(i) of the number of each particle that contact of the cloth with itself remembers.
template <class Self, class Visit>
void for_each_particle_number(Self& self, const Visit& visit) {
  auto& [stiffness, pairs, loose, crossed_at_start, coupled, friction, ordered_for] = self;
  for (auto& i : loose) visit(i);
  for (auto* list : {&coupled, &ordered_for})
    for (auto& pair : *list)
      for (auto& i : pair) visit(i);
  for (auto& [edges, vertices, range, target] : pairs)
    for (auto& i : vertices) visit(i);
  for (auto& [edges, vertices, tether, slides] : friction)
    for (auto& i : vertices) visit(i);
}

/// What a state remembers of a cloth goes over to what has become of it: `after` has the particles of
/// `before` in their places, some of them moved, perhaps more behind them, and other elements. Contact and
/// friction of what has stayed is as it was; what is new or was moved is noted as fresh. Throws
/// std::invalid_argument, the state as it was, if it is not of `before`, or `after` has fewer particles.
void carry_memory(const Cloth& before, const Cloth& after, SimulateState& state);

}  // namespace furrow::physics
