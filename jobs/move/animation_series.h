// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>

#include "io/scene/scene.h"
#include "jobs/base/inputs.h"
#include "jobs/move/frame_recorder.h"

namespace furrow::jobs {

/// The animations of a run. A file of positions is of one mesh: after a round of lines another one begins
/// (hang.pc2, hang-2.pc2).
class AnimationSeries {
 public:
  /// As the output says; without a name for animations nothing is done.
  AnimationSeries(const io::SceneOutput& output, const Frame& frame);
  bool is_on() const { return !output_.animation.empty(); }
  /// From now on, unless a file is being recorded already.
  void start(const geometry::Mesh& mesh, double time, std::span<const physics::Vec3> x);
  void observe(double time, std::span<const physics::Vec3> x);
  /// Writes what is being recorded.
  void finish();
  const std::vector<AnimationReport>& reports() const { return reports_; }  ///< of the files written

 private:
  const io::SceneOutput& output_;
  const Frame& frame_;
  std::optional<FrameRecorder> recorder_;
  std::vector<AnimationReport> reports_;
};

}  // namespace furrow::jobs
