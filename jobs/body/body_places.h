// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <vector>

#include "io/animation/animation_file.h"
#include "io/scene/scene.h"
#include "jobs/base/inputs.h"

namespace furrow::jobs {

/// Where the vertices of a scene's body are while it moves, in the order of its file: for showing it.
class BodyPlaces {
 public:
  /// `at_start`: its vertices as its file has them [m]; `frame`: of the scene's files. Throws as
  /// io::open_frames().
  BodyPlaces(const io::SceneBody& body, std::vector<physics::Vec3> at_start, const Frame& frame);
  bool moves() const;
  /// At a time [s]; between frames, linear. Three numbers a vertex [m].
  std::vector<float> at(double time) const;

 private:
  physics::RigidMotion motion_;
  std::vector<physics::Vec3> at_start_;
  std::unique_ptr<io::FrameSource> frames_;  ///< null: it is rigid
};

}  // namespace furrow::jobs
