// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/move/animation_series.h"

#include "jobs/base/read_inputs.h"

namespace furrow::jobs {

AnimationSeries::AnimationSeries(const io::SceneOutput& output, const Frame& frame)
    : output_(output), frame_(frame) {}

void AnimationSeries::start(const geometry::Mesh& mesh, double time, std::span<const physics::Vec3> x) {
  if (!is_on() || recorder_) return;
  std::filesystem::path path = output_.animation;
  if (!reports_.empty())
    path.replace_filename(path.stem().string() + "-" + std::to_string(reports_.size() + 1) +
                          path.extension().string());
  recorder_.emplace(path, mesh, io::AnimationOptions{output_.fps, time, write_options(frame_), {}});
  recorder_->observe(time, x);
}

void AnimationSeries::observe(double time, std::span<const physics::Vec3> x) {
  if (recorder_) recorder_->observe(time, x);
}

void AnimationSeries::finish() {
  if (recorder_) reports_.push_back(recorder_->close());
  recorder_.reset();
}

}  // namespace furrow::jobs
