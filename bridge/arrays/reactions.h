// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <vector>

#include "physics/cloth/cloth.h"

namespace furrow::bridge {

/// Forces on a cloth that lies still, which add up to none [N].
struct Reactions {
  physics::Vec3 weight = physics::Vec3::Zero();
  std::vector<physics::Vec3> held;                ///< of what holds each group of particles
  physics::Vec3 contact = physics::Vec3::Zero();  ///< on all that is not held: of bodies and other cloth
};

/// What must bear the particles for none to move: the negative of elements and weight. A particle counts in
/// the first group that has it; one that is held, but in no group, is left out. The contact is as exact as
/// the rest is. Cost: one pass. Throws std::out_of_range for a particle that there is not.
Reactions reactions(const physics::Cloth& cloth, const physics::Vec3& gravity,
                    std::span<const std::vector<int>> groups);

/// The tension of a band of springs, as a mean over its length [N]; 0 for none, < 0 where it is pushed.
double mean_tension(std::span<const physics::Spring> band, std::span<const physics::Vec3> x);

}  // namespace furrow::bridge
