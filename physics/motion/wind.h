// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "physics/base/thread_pool.h"
#include "physics/motion/simulate.h"
#include "physics/packed/packed_cloth.h"

namespace furrow::physics {

/// Throws std::invalid_argument for a number that is not finite or times that do not increase.
void check(const Wind& wind);
/// Whether the air is at rest everywhere at all times.
bool is_still(const Wind& wind);
double gust_factor(const Wind& wind, double time);
/// w [m/s]; needs check(wind).
Vec3 air_velocity(const Wind& wind, const Vec3& x, double time);

/// v = w + (v - w) decay for what is not pinned, with the air of one time.
void blow(PackedCloth& cloth, const Wind& wind, double time, double decay, ThreadPool& pool);

/// The air's velocity at each place of the cloth at one time [m/s].
void air_at(const PackedCloth& cloth, const Wind& wind, double time, std::vector<Vec4>& air,
            ThreadPool& pool);

}  // namespace furrow::physics
