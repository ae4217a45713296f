// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "jobs/base/inputs.h"
#include "physics/motion/simulate.h"

namespace furrow::jobs {

/// An integrator and its step: what the judgement of a scene chooses.
struct Candidate {
  std::string name;  ///< "leapfrog, 0.45 of the limit"
  physics::Integrator integrator = physics::Integrator::leapfrog;
  std::optional<double> dt;  ///< [s]; none: 0.9 of the limit, as it is estimated on the way
  bool forced = false;       ///< dt although it is above the limit
  int iterations = 0;      ///< XPBD's sweeps, implicit steps' of Newton's method, about; 0: others have none
  double expected_dt = 0;  ///< the first step, for predictions [s]
};

/// How far two shapes of one garment are apart, each as a share of the garment's size [-].
struct ShapeDistance {
  double rms = 0;      ///< of the vertices, weighted with their masses
  double max = 0;      ///< of the farthest vertex
  double surface = 0;  ///< from each surface to the other, RMS over both areas; sliding along it is none
  double centre = 0;   ///< of the centres of mass
  double extent = 0;   ///< of the distances (RMS) from those
  double borders = 0;  ///< of centre or extent of the border loop where that is largest
  double energy = 0;   ///< of the energies: how far the garment would have to be lifted for it

  /// What a chaotic motion still determines: the largest of surface, centre and extent, never above `rms`.
  double shape() const { return std::max({surface, centre, extent}); }
  /// The name of that one.
  const char* largest() const {
    return surface == shape() ? "surface" : centre == shape() ? "centre" : "extent";
  }
};

inline constexpr ShapeDistance infinitely_far{INFINITY, INFINITY, INFINITY, INFINITY,
                                              INFINITY, INFINITY, INFINITY};

struct JudgeOptions {
  double tolerance = 0.01;  ///< as a share of the garment's size [-]; in (0, 1)
  double budget = 60;       ///< predicted seconds of one thread for all runs [s]; > 0
};

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

  /// Whether it chose, and was not broken off.
  bool has_answer() const { return broken == Broken::no && chosen >= 0; }
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

/// Speed against accuracy of integrators and steps on a scene.
struct ChartJob {
  SceneInput scene;
  std::string name;  ///< of the scene, in the report and as the picture's title
  JudgeOptions options;
  std::filesystem::path csv;      ///< the numbers, to be written; empty: not
  std::filesystem::path picture;  ///< .svg or .png, drawn by gnuplot; empty: none
};

struct ChartReport {
  std::string scene;      ///< the job's name for it
  Judgement judgement;    ///< with what was done, where it was broken off
  bool scene_dt = false;  ///< the scene names a step
};

/// Its options (jobs/base/card.h).
std::vector<CardRow> card(ChartJob& job);

/// Judges a scene (jobs/move/judge.h) and writes numbers and picture, each whole or not at all. A listener
/// that cancels breaks the judgement off: what was done is in the report. Throws as judge(), and as
/// jobs::simulate() does.
ChartReport chart(const ChartJob& job, Listener& listener);

Json to_json(const ChartReport& report);

}  // namespace furrow::jobs
