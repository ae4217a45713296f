// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include "physics/motion/simulate.h"
#include "physics/pairs/cloth_contact.h"

namespace furrow::physics {

/// What contact of a cloth with itself remembers from step to step, as a state holds it: by particle, of a
/// contact that is by place. particle: of each place. stiffness: of its push [N/m]; > 0.
SelfContactMemory memory_of(const ClothContact& contact, double stiffness, std::span<const int> particle);
/// By place in place of by particle, what was coupled with the later place first, sorted.
SelfContactMemory by_place(SelfContactMemory known, std::span<const int> particle);
/// Goes on at x as one that had this memory there; nothing happens if that is of none. fresh: particles of
/// which, and of their neighbours, it knows nothing; there it goes on as it was made. What is known of
/// triangles and edges that are no more is forgotten. Throws std::invalid_argument for a particle that is not
/// there.
void recall_pairs(const SelfContactMemory& known, std::span<const int> fresh, std::span<const int> particle,
                  std::span<const Vec3> x, ClothContact& contact, ThreadPool* pool);

/// The cloth for a ClothContact: particles that are led have a mass there, as they may meet what is held.
Cloth with_free_leads(Cloth cloth, std::span<const int> led);

}  // namespace furrow::physics
