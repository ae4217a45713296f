// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>

#include "bridge/draw_more.h"
#include "io/scene.h"
#include "io/wrinkle_record.h"

namespace furrow::cli {

/// A round of lines: what `wrinkle` and the rounds of a scene share.
struct LineRound {
  geometry::WrinkleReport report;
  int first_line = 0;                            ///< id of the round's first line
  std::optional<bridge::DrawMoreReport> moving;  ///< drawn into a cloth in motion: the rest of the report
};

/// Draws the lines into the garment and notes them in its wrinkle record, going on from earlier rounds: their
/// ids, the mean rest lengths before any line, the density (unless `density` is given). With `state` the
/// garment is in motion, and `springs` are those of its simulation.
LineRound draw_lines(io::MeshFile& file, const std::vector<geometry::Stroke>& strokes,
                     const io::SceneLines& lines, std::optional<double> density,
                     const geometry::StageObserver& observer = {}, physics::SimulateState* state = nullptr,
                     const bridge::GatherOptions& springs = {});

/// Leaves out the strokes with these names. Throws UsageError for a name that no stroke has.
void leave_out(std::vector<geometry::Stroke>& strokes, const std::vector<std::string>& names);

}  // namespace furrow::cli
