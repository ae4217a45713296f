// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "jobs/judgement.h"
#include "jobs/scene_input.h"

namespace furrow::jobs {

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

/// Judges a scene (jobs/judge.h) and writes numbers and picture, each whole or not at all. A listener that
/// cancels breaks the judgement off: what was done is in the report. Throws as judge(), and as
/// jobs::simulate() does.
ChartReport chart(const ChartJob& job, Listener& listener);

Json to_json(const ChartReport& report);

}  // namespace furrow::jobs
