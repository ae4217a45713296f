// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "jobs/move/simulate.h"
#include "jobs/sketch/sketch.h"

namespace furrow::jobs {

inline constexpr double longest_play = 600;  ///< of all plays after one another [s]

/// How a sketch is to move.
struct PlayRequest {
  std::optional<std::filesystem::path> state;  ///< gone on from; none: it begins at rest, at time 0
  double seconds = longest_play;               ///< of its own time, at most [s]; > 0
  std::filesystem::path new_state;             ///< where the state reached is written; its folder is there
  /// Called on the way in the job's thread: time [s], and three numbers a vertex by its index [m].
  std::function<void(double time, const std::vector<float>& positions)> watch = {};
  /// The same of a body that moves, before the cloth's; in the order of the sketch's body.
  std::function<void(const std::vector<float>& positions)> watch_body = {};
  Hand hand = {};  ///< that may pull at the cloth
};

/// A sketch that has moved.
struct PlayedSketch {
  io::MeshFile file;                 ///< where it was stopped [m]
  double time = 0;                   ///< from the first play on [s]
  std::vector<std::string> remarks;  ///< of what is wrong with it; empty: nothing was seen
};

/// Moves the cloth until its time is over or the listener cancels, which is no error once a step was taken.
/// From the beginning it draws the strokes and moves as furrow simulate moves the saved scene, to the same
/// bits where that has 600 seconds, too (the step is a share of them). From a state on, strokes are drawn
/// into the moving cloth, which keeps its velocities. Rounds of lines that a scene draws later are left out.
/// Throws as simulate(), and std::runtime_error where the cloth diverges.
PlayedSketch play_sketch(const Sketch& sketch, const Json& strokes, const PlayRequest& request,
                         Listener& listener);

/// Where the vertices of the sketch's body are at a time [s], three numbers each [m]; of no body, or one that
/// does not move, nothing.
std::vector<float> body_at(const Sketch& sketch, double time);

}  // namespace furrow::jobs
