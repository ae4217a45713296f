// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>

#include "physics/body/posed_collider.h"
#include "physics/motion/simulate.h"

namespace furrow::bridge {

/// The body where it stands when a simulation begins; none if there is none. The world's collider must
/// outlive it.
inline std::optional<physics::PosedCollider> standing_body(const physics::World& world) {
  if (!world.collider) return {};
  return std::optional<physics::PosedCollider>(std::in_place, *world.collider,
                                               physics::pose(world.body_motion, 0));
}

}  // namespace furrow::bridge
