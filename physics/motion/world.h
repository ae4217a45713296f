// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "physics/body/animated_body.h"
#include "physics/body/collider.h"
#include "physics/body/rigid_motion.h"
#include "physics/motion/moved_pins.h"
#include "physics/motion/wind.h"

namespace furrow::physics {

/// What surrounds a cloth. What is not used costs nothing. Pointers may be null and must outlive the call.
struct World {
  const Collider* collider = nullptr;  ///< a rigid body, in its own frame
  RigidMotion body_motion;             ///< takes it from there into the world
  AnimatedBody* animated = nullptr;    ///< or a body that changes its shape; not both
  std::vector<MovedPins> pins;
  Wind wind;
};

}  // namespace furrow::physics
