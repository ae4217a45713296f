// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "physics/motion/simulate.h"

namespace furrow::jobs {

/// How often a run is observed: often enough that one that is cancelled ends soon, by counts and never by a
/// clock.
struct Observation {
  int steps = physics::SimulateOptions{}.observe_steps;  ///< between two calls of the observer
  int shown = 1;  ///< steps between two that an animation sees; its frames are interpolated between them

  /// Whether an animation sees this one; `stop`: where the run ends [s].
  bool shows(const physics::SimulateProgress& p, double stop) const {
    return p.step % shown == 0 || p.time >= stop;
  }
};

/// Seconds of one thread by jobs/cloth/cost_table.h; every tenth vertex asks for the body's distance.
double cost_of_step(const physics::SimulateOptions& options, const physics::Cloth& cloth, bool has_body);

/// As many steps as take 0.2 s by jobs/cloth/cost_table.h, at most 100, one of those that factorise. An
/// animation sees one in 1/240 s, or each where they are longer. What the run comes to does not depend on it.
/// Cost: with an animation and without a `dt`, an estimate of the limit (physics/linear/stable_step.h).
Observation observation_of(const physics::SimulateOptions& options, const physics::Cloth& cloth,
                           bool has_body, bool animated);

}  // namespace furrow::jobs
