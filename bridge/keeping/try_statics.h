// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "bridge/keeping/keep_trial.h"

namespace furrow::bridge {

/// What a search for rest came to.
struct StaticTrial {
  std::vector<double> kept;  ///< of each line, shares of the height at the start [-]; NaN: not reached
  double drift = 0;          ///< of any particle [m]
  bool stopped = false;      ///< by go_on
};

/// As try_shape()'s calm, with a search for rest (physics/rest/settle.h) in place of motion, from the push
/// on. It finds in a fraction of the time what motion would lose, too; a line that stays holds at rest, and
/// no more is known. work: shared with other trials. go_on: asked in each iteration; may be empty. Cost: 0.4
/// s at 3,000 vertices and up to 6 s at 11,000. Throws as settle().
StaticTrial try_statics(const physics::Cloth& start, const physics::World& world, const KeepOptions& options,
                        LineMeter& meter, physics::StiffnessWork& work, const std::function<bool()>& go_on);

}  // namespace furrow::bridge
