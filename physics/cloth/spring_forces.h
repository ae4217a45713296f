// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include "physics/cloth/cloth.h"
#include "physics/cloth/stiffness.h"

namespace furrow::physics {

/// Springs of energy  E = 1/2 k (l - L)^2,  l = |x_b - x_a|,  n = (x_b - x_a)/l.  A spring of length 0 has no
/// direction and exerts no force. Sums run in the order of `springs`. Method S1.1.
/// x, u, force, product: one entry a particle. Cost: one pass over the springs.
/// Throw std::invalid_argument, nothing changed, if lengths differ or a spring names a particle out of range.

/// The energy [J].
double spring_energy(std::span<const Vec3> x, std::span<const Spring> springs);

/// Adds the force [N]:  on a  k (l - L) n,  on b the opposite.
void add_spring_forces(std::span<const Vec3> x, std::span<const Spring> springs, std::span<Vec3> force);

/// Adds K u [N] for a displacement u [m], K the second derivative of the energy:
///   K_ab-block = k n n^T + k (1 - L/l) (I - n n^T),  applied to u_a - u_b, on a plus, on b minus.
void add_spring_stiffness_product(std::span<const Vec3> x, std::span<const Spring> springs,
                                  std::span<const Vec3> u, Stiffness stiffness, std::span<Vec3> product);

/// Hands out the blocks of K: of each spring (a, a), (a, b), (b, a), (b, b), zero if its length is 0, so that
/// the sequence of (i, j) is the same for all x.
void add_spring_stiffness(std::span<const Vec3> x, std::span<const Spring> springs, Stiffness stiffness,
                          const BlockSink& sink);

/// One spring's, whose particles are in range: adds its forces and returns its energy; its blocks on and
/// below the diagonal.
double add_forces(std::span<const Vec3> x, const Spring& spring, std::span<Vec3> force);
void stiffness_blocks(std::span<const Vec3> x, const Spring& spring, Stiffness stiffness, Mat3* lower);

}  // namespace furrow::physics
