// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <span>
#include <tuple>

#include "physics/cloth/cloth.h"
#include "physics/cloth/stiffness.h"

namespace furrow::physics {

/// Springs of energy  E = 1/2 k (l - L)^2,  l = |x_b - x_a|,  n = (x_b - x_a)/l.  A spring of length 0 has no
/// direction and exerts no force. Method S1.1. What elements.h asks of a kind:

inline std::array<int, 2> vertices(const Spring& s) { return {s.a, s.b}; }
inline void renumber(Spring& s, std::span<const int> place) { s.a = place[s.a], s.b = place[s.b]; }
inline auto fields(const Spring& s) { return std::tuple(s.a, s.b, s.rest_length, s.stiffness); }
/// Throws std::invalid_argument if it names a particle out of range.
void check(const Spring& spring, std::size_t particles);
double energy(std::span<const Vec3> x, const Spring& spring);
/// On a  k (l - L) n,  on b the opposite [N].
double add_forces(std::span<const Vec3> x, const Spring& spring, std::span<Vec3> force);
/// Zero if its length is 0.
void stiffness_blocks(std::span<const Vec3> x, const Spring& spring, Stiffness stiffness, Mat3* lower);

/// Adds K u [N] for a displacement u [m] of one entry a particle, K the second derivative of the energy:
///   K_ab-block = k n n^T + k (1 - L/l) (I - n n^T),  applied to u_a - u_b, on a plus, on b minus.
/// Cost: one pass. Throws std::invalid_argument, nothing changed, if lengths differ or as check() does.
void add_spring_stiffness_product(std::span<const Vec3> x, std::span<const Spring> springs,
                                  std::span<const Vec3> u, Stiffness stiffness, std::span<Vec3> product);

}  // namespace furrow::physics
