// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <vector>

#include "physics/body/collider.h"
#include "physics/body/rigid_motion.h"

namespace furrow::physics {

class AnimatedBody;

/// Pinned particles that are led: after every step each is exactly at  pose(t) home,  where home is its
/// position in the motion's frame; during the step its velocity is the way that it goes in it over dt.
struct MovedPins {
  std::vector<int> particles;  ///< pinned ones (see pin()); in no two groups
  RigidMotion motion;
};

struct Gust {
  double time;    ///< [s]; strictly increasing
  double factor;  ///< [-]
};

/// Moving air:  w(x, t) = factor(t) velocity + rate(t) axis x (x - centre).  The drag then pulls towards it:
/// v - w decays by exp(-air_drag t), exactly, whichever way the cloth faces. Without drag wind does nothing.
struct Wind {
  Vec3 velocity = Vec3::Zero();  ///< [m/s]
  std::vector<Gust> gusts;       ///< factor; linear between, held outside; none: 1
  std::optional<Spin> swirl;     ///< air that turns like a rigid body
};

/// What surrounds a cloth. What is not used costs nothing. Pointers may be null and must outlive the call.
struct World {
  const Collider* collider = nullptr;  ///< a rigid body, in its own frame
  RigidMotion body_motion;             ///< takes it from there into the world
  AnimatedBody* animated = nullptr;    ///< or a body that changes its shape; not both
  std::vector<MovedPins> pins;
  Wind wind;
};

}  // namespace furrow::physics
