// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include "physics/motion/simulate.h"
#include "physics/pairs/cloth_contact.h"

namespace furrow::physics {

/// What contact of a cloth with itself remembers from step to step, as a state holds it. stiffness: of its
/// push [N/m]; > 0.
SelfContactMemory memory_of(const ClothContact& contact, double stiffness);
/// Goes on at x as one that had this memory there; nothing happens if that is of none. Throws
/// std::invalid_argument if it is of another cloth.
void recall_pairs(const SelfContactMemory& known, std::span<const Vec3> x, ClothContact& contact,
                  ThreadPool* pool);

/// The cloth for a ClothContact: particles that are led have a mass there, as they may meet what is held.
Cloth with_free_leads(Cloth cloth, std::span<const int> led);

}  // namespace furrow::physics
