// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>

#include "physics/cloth/strain.h"
#include "physics/contact/contact.h"
#include "physics/motion/simulate_state.h"
#include "physics/motion/world.h"

namespace furrow::physics {

enum class Outcome { finished, stopped_by_observer, diverged, stopped_at };

/// Counts, times and smallest steps are of all calls that shared a state.
struct SimulateReport {
  Outcome outcome = Outcome::finished;
  std::int64_t steps = 0;
  double time = 0;                      ///< reached [s]
  double dt = 0, dt_smallest = 0;       ///< of the last step, and the smallest [s]
  double dt_limit = 0;                  ///< of the integrator, as last estimated [s]; infinity: there is none
  double dt_limit_smallest = 0;         ///< [s]
  double seconds = 0, cpu_seconds = 0;  ///< clock and processor time (all threads) [s]
  StrainStatistics strain;              ///< structural springs (else edges of the membrane) at the end
  double kinetic_energy = 0;            ///< [J]; what rests on the body keeps the last half-kick, g dt/2
  double residual_force =
      0;             ///< see residual_force() [-]; of springs, weight and contact with a body at rest
  int contacts = 0;  ///< particles at the body at the end
  int limit_estimates = 0;
  std::int64_t force_evaluations = 0, collider_queries = 0;
  std::int64_t linear_solves = 0, factorisations = 0, iterations = 0;  ///< see WorkCounts
  /// Elements times evaluations; 0 shows that a kind that is absent cost nothing.
  std::int64_t spring_evaluations = 0, triangle_evaluations = 0, hinge_evaluations = 0;
  std::int64_t truncated_moves = 0;        ///< cut short against tunnelling
  std::int64_t frames_built = 0;           ///< fields of an animated body
  double frame_seconds = 0;                ///< clock time spent on them [s]
  double compensation_left = 0;            ///< share of the compensating forces that still acts [-]
  Vec3 compensation_force = Vec3::Zero();  ///< their sum now [N]
};

/// Fills all but outcome, dt and its limits from the state, and from cloth and world as they are at its time
/// (an animated body prepared for it). Cost: one force evaluation, two queries a particle.
void measure(const Cloth& cloth, const World& world, const SimulateState& state, const Vec3& gravity,
             const ContactOptions& contact, SimulateReport& report);

}  // namespace furrow::physics
