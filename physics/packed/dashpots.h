// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "physics/base/thread_pool.h"
#include "physics/packed/packed_cloth.h"

namespace furrow::physics {

/// The springs' damping as forces, for integrators that take it as such (others: DampingSweep):
///   on a  c ((v_b - v_a) . n) n,  on b the opposite,  c = 2 zeta sqrt(k m),  k = PackedCloth::damping_k,
/// m = 1/(1/m_a + 1/m_b) the reduced mass, so that zeta = 1 is critical for the two ends alone. Coefficients
/// c [N s/m] in the order of the packed springs; empty if zeta is 0; 0 for a spring between two pins.
std::vector<double> dashpots(const PackedCloth& cloth, double zeta);

/// Adds the forces at x and v to `force`, in the order of the sweep; inv_length2 must be that of x.
void add_dashpot_forces(PackedCloth& cloth, const std::vector<double>& c, ThreadPool& pool);

/// An upper bound of the rates [1/s] at which dashpots c make velocities decay: the largest row sum of M^-1
/// C. Cost: one pass over the springs.
double fastest_decay(const PackedCloth& cloth, const std::vector<double>& c);

}  // namespace furrow::physics
