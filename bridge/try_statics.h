// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "bridge/keep_trial.h"

namespace furrow::bridge {

/// As try_shape(), with searches for rest (physics/rest/settle.h) in place of motion: from the push, and with
/// `blow` then under a steady gust of 1.15 times the options', as motion swings out farther than rest, and
/// back; without, kept_gust is 1. It finds in a fraction of the time what motion would lose, too; what it
/// lets pass may still be lost in motion, so a line that stays holds at rest, and no more is proved. work:
/// shared with other trials. go_on: asked in each iteration. Cost: three searches, 2 to 6 s at 3,000 to
/// 11,000 vertices, a tenth of it without `blow`. Throws as settle().
KeepTrial try_statics(const physics::Cloth& start, const physics::World& world, const KeepOptions& options,
                      bool blow, LineMeter& meter, physics::StiffnessWork& work,
                      const std::function<bool(double)>& go_on);

}  // namespace furrow::bridge
