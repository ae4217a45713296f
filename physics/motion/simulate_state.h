// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <limits>
#include <vector>

#include "physics/body/collider.h"
#include "physics/cloth/cloth.h"

namespace furrow::physics {

/// What a report counts over all calls that shared a state.
struct SimulateTotals {
  std::int64_t force_evaluations = 0, collider_queries = 0, truncated_moves = 0;
  std::int64_t linear_solves = 0, factorisations = 0, iterations = 0;  ///< see WorkCounts
  std::int64_t spring_evaluations = 0, triangle_evaluations = 0, hinge_evaluations = 0;
  std::int64_t limit_estimates = 0, frames_built = 0;
  double dt_smallest = std::numeric_limits<double>::infinity();        ///< [s]
  double dt_limit_smallest = std::numeric_limits<double>::infinity();  ///< of leapfrog [s]
  double seconds = 0, cpu_seconds = 0, frame_seconds = 0;              ///< [s]
};

/// Forces that keep a cloth from jumping when its springs were changed under strain: applied as
///   -force exp(-(t - start) / time_constant),
/// forgotten when the factor falls below 1e-9. Springs along a line that splits an edge do not pull as the
/// edge did, whatever their rest lengths (unlike a membrane's triangles), so an insertion under strain jumps
/// without it.
struct Compensation {
  std::vector<Vec3> force;     ///< one a particle [N]; empty: none
  double start = 0;            ///< [s]
  double time_constant = 0.3;  ///< [s]; > 0, may be infinite
};

/// All that a simulation knows besides cloth, world and options. A call of simulate() that is stopped at any
/// step and continued with the same state, cloth, world and options gives the bits of one that was not
/// stopped, for any number of threads. A default state is the beginning. Plain numbers and arrays: a file can
/// hold them (bit by bit, with infinity and NaN). After a change of the cloth set `planned` to false, and add
/// a force_jump() to the compensation if the cloth was strained.
struct SimulateState {
  double time = 0;        ///< [s]
  std::int64_t step = 0;  ///< steps made

  /// The plan: steps_left steps of dt until `end`. false, as after a change of the cloth: estimate the limit
  /// and divide the rest anew, and forget `contact`.
  bool planned = false;
  double end = 0;         ///< [s]
  double dt = 0;          ///< [s]
  double dt_longest = 0;  ///< that the plan allows [s]
  std::int64_t steps_left = 0;
  std::int64_t estimated_at = 0;  ///< step of the last estimate of the limit
  double dt_limit = 0;            ///< the estimate, of leapfrog, whatever integrates [s]; 0: none was made
  double strain_at_estimate = 0;  ///< largest strain then [-]
  std::uint64_t cloth = 0;        ///< fingerprint() of the cloth that the plan is for

  std::vector<ContactMemory> contact;  ///< one a particle, or empty
  double body_travel = 0;              ///< of an animated body since the beginning, a bound [m]
  /// Of each of World::pins, one after the other, the particles' positions in the motion's frame [m]. Empty:
  /// taken from where the particles are now.
  std::vector<Vec3> homes;
  Compensation compensation;
  SimulateTotals totals;
};

/// Tells one cloth's elements and masses from another's: a plan is made anew when they changed at a stop. Of
/// Cloth::energies it knows only how many there are: a caller that changes one for another at a stop must
/// make the plan anew (planned = false).
std::uint64_t fingerprint(const Cloth& cloth);

/// Throws std::invalid_argument if the state contradicts itself or does not fit a cloth of so many particles.
void check(const SimulateState& state, std::size_t particles);

}  // namespace furrow::physics
