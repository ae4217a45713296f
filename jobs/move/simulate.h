// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bridge/draping/drape.h"
#include "io/scene/state_file.h"
#include "jobs/base/ends.h"
#include "jobs/base/inputs.h"
#include "jobs/cloth/shape_report.h"
#include "jobs/draw/drawn_round.h"
#include "jobs/move/chart.h"
#include "physics/body/exact_distance.h"
#include "physics/motion/simulate.h"
#include "physics/rest/settle.h"

namespace furrow::jobs {

/// An animation that was written.
struct AnimationReport {
  std::filesystem::path file;
  double start = 0;  ///< time of the first frame [s]
  double fps = 25;   ///< [1/s]
  std::size_t frames = 0;
};

/// A garment that came to rest before it moved.
struct RestStage {
  physics::SettleReport settle;
  double angle_defect_before = 0, angle_defect = 0;  ///< how knobbly it was drawn, and is at rest [rad/m^2]
  ClothCrossings crossings;                          ///< at rest
  EndFacts end;
  double seconds = 0;  ///< that this took [s]
};

/// What is wrong with a shape that was reached: a word for the outcome, and a sentence with the remedy.
struct Fault {
  std::string word;  ///< "cloth crosses itself"
  Warning told;
};

/// What jobs::simulate() did.
struct SimulateReport {
  std::string title;                ///< of the scene
  std::optional<Judgement> choice;  ///< of integrator and step, where a tolerance was asked for
  bool scene_dt = false;            ///< the settings named a step before the choice
  physics::Integrator integrator = physics::Integrator::leapfrog;  ///< of its last steps
  std::optional<ChosenSteps>
      steps;         ///< why those, where the settings leave it open; none: they, or the state, say
  bool ran = false;  ///< false: nothing meets the tolerance; what follows is empty
  physics::SimulateReport run;  ///< of the whole run; its outcome
  /// Processor time by part [s], of steps and of what was written; none: it was not asked for.
  std::optional<physics::WorkTimes> times;
  /// At its end, beside `run.kinetic_energy`; weight against the origin, contact left 0; none: it diverged.
  std::optional<bridge::EnergyParts> energy;
  std::optional<ReachedShape> shape;      ///< none: it diverged
  std::optional<bridge::KeptShape> kept;  ///< at time 0
  std::optional<RestStage> rest;          ///< at time 0, where the settings ask for it
  std::vector<DrawnRound> rounds;
  std::vector<AnimationReport> animations;  ///< written
  std::vector<Warning> warnings;            ///< about the result; those on the way went to the listener
  std::string failure;                      ///< of a run that diverged: why, and what helps; else ""
  std::vector<Fault> faults;                ///< of the shape reached, which make the run no success
  io::MeshFile garment;                     ///< at the end [m], y up; not of a run that diverged
  Frame frame;                              ///< of the files written
  geometry::Owned<Json> settings;           ///< that were run, paths relative to the working directory
  std::string state;                        ///< that was gone on from: its path, and its settings
  geometry::Owned<Json> settings_before;

  /// "finished", "stopped", "interrupted" or "diverged", of no step after it came to rest "at rest", and what
  /// is wrong with the shape reached.
  std::string outcome() const;
  bool fails() const { return !failure.empty() || !faults.empty(); }
};

/// The report for programs, and what the command line prints. (Its equivalent flags are the command line's.)
Json to_json(const SimulateReport& report);

/// Sees a run go on: the time [s], and where the vertices are by their index [m].
using Watch = std::function<void(double time, std::span<const physics::Vec3> x)>;

/// A vertex that a hand has taken hold of, and the place that it pulls it to.
struct Grip {
  int vertex = 0;              ///< its index
  std::array<double, 3> to{};  ///< [m]
  bool operator==(const Grip&) const = default;
};

/// Where the hand is at a time [s]; none: it has let go. Asked before each step that is observed, so equal
/// answers at equal times give equal bits; must not throw. What it does, jobs/move/hand_on_cloth.h tells.
using Hand = std::function<std::optional<Grip>(double time)>;

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
  bool times = false;         ///< whether processor time is divided among parts; no result depends on it
  bool needs_output = false;  ///< settings that name no output are refused
  /// Below which the outputs that a scene file names must lie; none: the scene's folder. Empty: the folder
  /// that the program runs in.
  std::optional<std::filesystem::path> outputs_below = {};
  /// Called in the run's thread, at each step of an integrator that factorises, else once in 1/240 s of
  /// motion at least; must not throw.
  Watch watch = {};
  Hand hand = {};  ///< that may pull at the cloth; empty: there is none
};

/// Its options (jobs/base/card.h).
std::vector<CardRow> card(SimulateJob& job);

/// The job that goes on from a state's file, under the settings that it holds. Throws as io::read_state().
SimulateJob resume_from(const std::filesystem::path& state);

/// Runs a scene: lines are drawn at their times, between them the cloth is simulated. Writes what the
/// settings' output names, each file whole or not at all, but a mesh named "-", which is in the report alone.
/// A run that is cancelled, or diverges, is no error: `run.outcome` tells; before its first step a cancelled
/// job throws physics::Cancelled. Throws std::invalid_argument for settings that cannot be,
/// geometry::ContentError for files that cannot be used, std::runtime_error for outputs that cannot be
/// written.
SimulateReport simulate(const SimulateJob& job, Listener& listener);

}  // namespace furrow::jobs
