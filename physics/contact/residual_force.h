// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include "physics/body/collider.h"
#include "physics/cloth/cloth.h"

namespace furrow::physics {

inline constexpr double contact_tolerance = 1e-5;  ///< [m] beyond the gap, where contact still bears
inline constexpr double standard_gravity = 9.81;   ///< [m/s^2]

/// How far a cloth is from rest: the largest net force on a particle that is not pinned, elements (see
/// elements.h) plus weight plus the best contact force inside the friction cone where the body is at most gap
/// + 1e-5 m away, relative to the particle's weight m |gravity| (standard gravity 9.81 m/s^2 where gravity is
/// 0). With -f = w split along the normal of smooth_at(), w_n and w_t, what contact cannot take is
///   0 if |w_t| <= mu w_n;   |w| if w_n <= -mu |w_t|;   (|w_t| - mu w_n) / sqrt(1 + mu^2) between.
/// collider may be null. loads: further forces that act whatever moves, one a particle [N]; may be empty. 0
/// if nothing can move; NaN for a gravity whose length is beyond numbers. Cost: one force evaluation, one
/// query a particle.
double residual_force(const Cloth& cloth, const Vec3& gravity, const Collider* collider, double friction,
                      double gap, std::span<const Vec3> loads = {});

/// The same of forces [N] that are known: of elements and loads, without weight and contact, one a particle.
double residual_of(std::span<const Vec3> force, const Particles& particles, const Vec3& gravity,
                   const Collider* collider, double friction, double gap);

}  // namespace furrow::physics
