// SPDX-License-Identifier: MIT
#pragma once
#include "physics/base/thread_pool.h"
#include "physics/packed/packed_cloth.h"

namespace furrow::physics {

/// inv_length2 and force of the springs at x, as add_spring_forces but for the order of sums: that of the
/// sweep, block by block (one thread each), then what lies between; so any number of threads gives the same
/// bits. A spring shorter than 1e-140 m pulls nowhere. Cost: one square root and one division a spring.
void update_spring_forces(PackedCloth& packed, ThreadPool& pool);

}  // namespace furrow::physics
