// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <span>
#include <vector>

#include "io/animation/animation_file.h"
#include "jobs/move/simulate.h"

namespace furrow::jobs {

/// Turns the positions at the times that a simulation shows into frames of equal distance in time, on
/// straight lines between two such times.
class FrameRecorder {
 public:
  /// `options.start` is the time of the first frame; the first call of observe() must not be later.
  FrameRecorder(std::filesystem::path path, const geometry::Mesh& mesh, const io::AnimationOptions& options);
  void observe(double time, std::span<const physics::Vec3> x);
  /// Writes the file and says what is in it.
  AnimationReport close();

 private:
  std::filesystem::path path_;
  io::AnimationOptions options_;
  io::AnimationWriter writer_;
  double time_ = 0;
  std::vector<physics::Vec3> x_;
};

}  // namespace furrow::jobs
