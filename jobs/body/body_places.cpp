// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/body/body_places.h"

#include <algorithm>

#include "jobs/base/read_inputs.h"
#include "jobs/body/world_body.h"

namespace furrow::jobs {
namespace {

std::vector<physics::Vec3> frame_at(const io::FrameSource& frames, double time) {
  const std::vector<double>& times = frames.times();
  const auto next = std::upper_bound(times.begin(), times.end(), time);
  if (next == times.begin()) return frames.positions(0);
  if (next == times.end()) return frames.positions(times.size() - 1);
  const auto i = static_cast<std::size_t>(next - times.begin());
  const double share = (time - times[i - 1]) / (times[i] - times[i - 1]);
  std::vector<physics::Vec3> x = frames.positions(i - 1);
  const std::vector<physics::Vec3> y = frames.positions(i);
  for (std::size_t k = 0; k < x.size(); ++k) x[k] += share * (y[k] - x[k]);
  return x;
}

}  // namespace

BodyPlaces::BodyPlaces(const io::SceneBody& body, std::vector<physics::Vec3> at_start, const Frame& frame)
    : motion_(body.motion), at_start_(std::move(at_start)) {
  if (body.frames.empty()) return;
  io::FrameSourceOptions options;
  if (body.fps > 0) options.fps = body.fps;
  options.frame = read_options(with_unit(frame, body.unit));
  frames_ = io::open_frames(body.frames, at_start_.size(), options);
}

bool BodyPlaces::moves() const { return frames_ || !physics::at_rest(motion_); }

std::vector<float> BodyPlaces::at(double time) const {
  std::vector<physics::Vec3> x = frames_ ? frame_at(*frames_, time) : at_start_;
  const physics::Pose pose = physics::pose(motion_, time);
  std::vector<float> list;
  list.reserve(3 * x.size());
  for (physics::Vec3& p : x) {
    if (!frames_) p = pose.to_world(p);
    for (int k = 0; k < 3; ++k) list.push_back(static_cast<float>(p[k]));
  }
  return list;
}

}  // namespace furrow::jobs
