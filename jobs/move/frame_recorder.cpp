// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/move/frame_recorder.h"

namespace furrow::jobs {

FrameRecorder::FrameRecorder(std::filesystem::path path, const geometry::Mesh& mesh,
                             const io::AnimationOptions& options)
    : path_(std::move(path)), options_(options), writer_(path_, mesh, options) {}

void FrameRecorder::observe(double time, std::span<const physics::Vec3> x) {
  constexpr double rounding = 1e-9;  // of a frame's time against the simulation's [s]
  while (writer_.next_time() <= time + rounding) {
    const double span = time - time_;
    const double share = x_.empty() || !(span > 0) ? 1 : std::min(1.0, (writer_.next_time() - time_) / span);
    std::vector<physics::Vec3> frame(x.begin(), x.end());
    if (share < 1)
      for (std::size_t i = 0; i < frame.size(); ++i) frame[i] = x_[i] + share * (x[i] - x_[i]);
    writer_.add(frame);
  }
  time_ = time;
  x_.assign(x.begin(), x.end());
}

AnimationReport FrameRecorder::close() {
  writer_.close();
  return {path_, options_.start, options_.fps, writer_.frames()};
}

}  // namespace furrow::jobs
