// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>

#include "io/scene/state_file.h"
#include "jobs/scene_input.h"
#include "jobs/simulate_report.h"

namespace furrow::jobs {

/// A scene to be run from its beginning, or from a saved state on.
struct SimulateJob {
  SceneInput scene;
  std::optional<io::SavedState> state;  ///< gone on from, in place of the garment
  std::filesystem::path
      state_path;  ///< where it was read from: its settings' paths are relative to its folder
  /// Error accepted, as a share of the garment's size [-], in (0, 1): integrator and step are chosen for it
  /// first, from the beginning only; none: those of the settings.
  std::optional<double> tolerance;
  double budget = 60;         ///< predicted seconds of one thread that choosing may take [s]; > 0
  bool needs_output = false;  ///< settings that name no output are refused
};

/// The job that goes on from a state's file, under the settings that it holds. Throws as io::read_state().
SimulateJob resume_from(const std::filesystem::path& state);

/// Runs a scene: lines are drawn at their times, between them the cloth is simulated. Writes what the
/// settings' output names, each file whole or not at all, but a mesh named "-", which is in the report alone.
/// A run that is cancelled, or diverges, is no error: `run.outcome` tells; before its first step a cancelled
/// job throws physics::Cancelled. Throws std::invalid_argument for settings that cannot be,
/// geometry::ContentError for files that cannot be used, std::runtime_error for outputs that cannot be
/// written.
SimulateReport simulate(const SimulateJob& job, Listener& listener);

/// Runs a scene until its last lines are drawn, or to its end, and writes nothing: the garment as it is then;
/// nothing if it was cancelled. Throws std::runtime_error if it diverges.
std::optional<io::SavedState> run_until_drawn(const OpenScene& scene, const Context& context);

}  // namespace furrow::jobs
