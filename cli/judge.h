// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "cli/candidates.h"
#include "cli/shape_distance.h"

namespace furrow::cli {

struct JudgeOptions {
  double tolerance = 0.01;  ///< as a share of the garment's size [-]; in (0, 1)
  double budget = 60;       ///< predicted seconds of one thread for all runs [s]; > 0
};

/// Throws UsageError for an option out of its range.
void check(const JudgeOptions& options);

enum class Fate {
  done,
  diverged,
  too_dear,  ///< not run: predicted to cost more than the reference
  not_run    ///< the judgement was broken off
};

struct JudgedCandidate {
  Candidate candidate;
  Fate fate = Fate::not_run;
  double cost = 0;  ///< seconds of one thread a simulated second, by the cost table [-]
  std::int64_t steps = 0;
  double dt = 0;            ///< of the last step [s]
  ShapeDistance off{};      ///< from the reference at the end; infinity: diverged or unknown
  double error = INFINITY;  ///< the one that judges: off.rms, or off.shape()
};

enum class Broken { no, interrupted, clock };

struct Judgement {
  JudgeOptions options;
  double seconds = 0, scene_seconds = 0;    ///< judged; of the scene's plan [s]
  bool shortened = false;                   ///< to what fits the budget
  bool ends_at_lines = false;               ///< not judged further because lines come then
  double size = 0;                          ///< of the garment [m]
  double dt_limit = 0;                      ///< leapfrog's at the start [s]
  bool by_shape = false;                    ///< errors are of the shape, because positions are chaotic
  std::string why;                          ///< which error, and why
  double twin_drift = 0;                    ///< of a run that began 1e-9 m beside, RMS over size [-]
  double reference_error = INFINITY;        ///< estimate, as `error` [-]
  std::vector<JudgedCandidate> candidates;  ///< the reference is the last one
  int chosen = -1;                          ///< the cheapest that meets the tolerance
  Broken broken = Broken::no;

  /// Whether error and the reference's own together stay within the tolerance; of chaotic motion, each does:
  /// what parts equals is in the candidate's error already.
  bool meets(const JudgedCandidate& c) const {
    const bool alone = by_shape || &c == &candidates.back();
    return c.error + (alone ? 0 : reference_error) <= options.tolerance &&
           reference_error <= options.tolerance;
  }
  /// Whether the error is above the reference's own, so that it is the candidate's.
  bool resolved(const JudgedCandidate& c) const { return c.error > reference_error; }
};

/// Runs reference, twin and candidates on the scene and chooses the cheapest that meets the tolerance. All by
/// counts: the same on every machine. Where the budget is too small for the scene's seconds, judges what fits
/// of them. A clock only breaks off, after 3 budgets and a minute; so does Ctrl-C; then what was done is in
/// the result. Shows progress. Throws UsageError as check() does, for a budget too small for 1/30 s, or
/// a scene that has no time or whose own setting no run would take (std::invalid_argument as simulate()).
Judgement judge(const SceneCloth& scene, const physics::World& world, const JudgeOptions& options,
                const CommonArguments& common);

}  // namespace furrow::cli
