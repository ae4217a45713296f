// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "physics/motion/simulate.h"

namespace furrow::physics {

/// Throws std::invalid_argument if there are forces, but not one for each particle, one is not finite, or the
/// time constant is not > 0.
void check(const Compensation& compensation, std::size_t particles);

/// exp(-(t - start) / time_constant), 1 before the start; 0 if there is none or it is below 1e-9.
double share_left(const Compensation& compensation, double time);

/// The force to compensate [N]: that of the elements `after` minus that `before`. The vertices of `before`
/// are the first ones of `after`; new ones count from 0. What stores energy pulls on nothing else, so that
/// the sum is 0. With a gravity [m/s^2] weights count too: then a change of masses does not jump either and a
/// new vertex does not fall before its springs carry it, but the sum is the weight of the mass that was
/// added. Cost: one force evaluation each. Throws std::invalid_argument if `after` has fewer vertices.
std::vector<Vec3> force_jump(const Cloth& before, const Cloth& after, const Vec3& gravity = Vec3::Zero());

/// Adds a jump at a time: what is left of the earlier forces goes on, with the same time constant; new
/// particles start at 0. Throws std::invalid_argument if the jump has fewer entries than there were.
void add(Compensation& compensation, const std::vector<Vec3>& jump, double time);

/// The net force that is applied at a time [N].
Vec3 net_force(const Compensation& compensation, double time);

}  // namespace furrow::physics
