// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "jobs/cloth/shape_report.h"

namespace furrow::jobs {

/// Leapfrog, or implicit steps where those take less than half of its time by jobs/cloth/cost_table.h:
/// leapfrog is the more exact of the two. A `dt` of the options that is above leapfrog's limit, up to
/// 1/15 s, is for implicit steps if those cost less than leapfrog at its own, unless it is forced. Never from
/// a clock, so equal cloths have equal steps. Cost: an estimate of the limit (physics/linear/stable_step.h).
ChosenSteps choose_steps(const physics::SimulateOptions& options, const physics::Cloth& cloth, bool has_body);

}  // namespace furrow::jobs
