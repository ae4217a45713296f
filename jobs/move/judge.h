// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "jobs/move/candidates.h"
#include "jobs/move/shape_distance.h"

namespace furrow::jobs {

/// Throws std::invalid_argument for an option out of its range.
void check(const JudgeOptions& options);

/// Runs reference, twin and candidates on the scene and chooses the cheapest that meets the tolerance. All by
/// counts: the same on every machine. Where the budget is too small for the scene's seconds, judges what fits
/// of them. A clock only breaks off, after 3 budgets and a minute; so does the listener; then what was done
/// is in the result. Shows progress. Throws std::invalid_argument as check() does, for a budget too small for
/// 1/30 s, or a scene that has no time or whose own setting no run would take (std::invalid_argument as
/// simulate()).
Judgement judge(const SceneCloth& scene, const physics::World& world, const JudgeOptions& options,
                const Context& context);

}  // namespace furrow::jobs
