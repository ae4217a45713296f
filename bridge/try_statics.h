// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "bridge/keep_trial.h"

namespace furrow::bridge {

/// As try_shape(), with searches for rest (physics/rest/settle.h) in place of motion: from the push, then
/// under a steady gust of 1.15 times the options', as motion swings out farther than rest, and back. It finds
/// in a fraction of leapfrog's time what motion would lose, too; what it lets pass may still be lost in
/// motion, so a line that stays holds at rest, and no more is proved. brief: the first search alone, as long
/// as it is no slower than the calm part of a run by implicit steps; what it does not say, kept_gust at
/// least, is 1. work: shared with other trials. go_on: asked in each iteration. Cost: three searches, 2 s at
/// 3,000 vertices and up to 20 s each at 11,000; if brief, 0.6 and 6 s at most. Throws as settle().
KeepTrial try_statics(const physics::Cloth& start, const physics::World& world, const KeepOptions& options,
                      bool brief, LineMeter& meter, physics::StiffnessWork& work,
                      const std::function<bool(double)>& go_on);

}  // namespace furrow::bridge
