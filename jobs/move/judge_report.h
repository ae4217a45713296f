// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "jobs/base/read_inputs.h"
#include "jobs/move/judge.h"

namespace furrow::jobs {

/// What was judged, how, and what is recommended; times by the cost table only, so that two calls say the
/// same.
Json to_json(const Judgement& j, bool scene_dt);

/// The recommendation, or why there is none, in words.
std::string words(const Judgement& j, bool scene_dt);

/// The components of an error, as reports name them.
inline constexpr std::pair<const char*, double ShapeDistance::*> distance_columns[] = {
    {"rms", &ShapeDistance::rms},         {"max", &ShapeDistance::max},
    {"surface", &ShapeDistance::surface}, {"centre", &ShapeDistance::centre},
    {"extent", &ShapeDistance::extent},   {"borders", &ShapeDistance::borders},
    {"energy", &ShapeDistance::energy}};
/// Whether the candidate came to its end, and so did the reference.
bool is_known(const JudgedCandidate& c);
/// Which of them is the candidate's error; the reference's own is an "estimate".
const char* kind_of_error(const Judgement& j, const JudgedCandidate& c);

/// "done", "diverged", "too dear" or "not run".
const char* name_of(Fate fate);
/// "meets" or "misses" the tolerance, "unknown" without a reference; else its fate.
const char* verdict_of(const Judgement& j, const JudgedCandidate& c);

}  // namespace furrow::jobs
