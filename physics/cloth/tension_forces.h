// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include "physics/cloth/cloth.h"
#include "physics/cloth/stiffness.h"

namespace furrow::physics {

/// The law of a Tension at the strain e = (l - L) / L, c = stretch where e > 0, else compress:
///   E = c L |e|^3 / 3,   T = c e |e|  (> 0 pulls),   dT/dl = 2 c |e| / L.
/// The slope is 0 at rest: a spring that is let go and called at rest below a force f keeps up to
/// remaining_strain(): not hysteresis, as the law has no loop, but it looks like it (method S2.4).
struct TensionLaw {
  double energy, force, slope;  ///< E [J], T [N], dT/dl [N/m], >= 0
};
TensionLaw tension_law(const Tension& tension, double strain);

/// e = sqrt(f / stretch) [-], the strain at which the pull is f [N]; f >= 0, stretch > 0 [N].
double remaining_strain(double stretch, double force);

/// Strain [-] at which cloth usually hangs: tension counts with its slope there where something asks for its
/// stiffness at rest (damping, the metric of prestress()).
inline constexpr double working_strain = 0.02;
/// dT/dl at a strain: tension_law(tension, strain).slope [N/m].
double tension_slope(const Tension& tension, double strain);

/// As the functions of springs do: energy [J]; forces [N], on a  T n,  on b the opposite, none at length 0;
/// blocks (a, a), (a, b), (b, a), (b, b) of K [N/m],  K = T' n n^T + T/l (I - n n^T).
/// Stiffness::positive_part leaves out the transverse part of what is compressed (K >= exact). At rest K is
/// 0. Cost: one pass. Throw std::invalid_argument, nothing changed, if lengths differ or as check() does.
double tension_energy(std::span<const Vec3> x, std::span<const Tension> tension);
void add_tension_forces(std::span<const Vec3> x, std::span<const Tension> tension, std::span<Vec3> force);
void add_tension_stiffness(std::span<const Vec3> x, std::span<const Tension> tension, Stiffness stiffness,
                           const BlockSink& sink);

/// One's, whose particles are in range: adds its forces and returns its energy; its blocks on and below the
/// diagonal.
double add_forces(std::span<const Vec3> x, const Tension& tension, std::span<Vec3> force);
void stiffness_blocks(std::span<const Vec3> x, const Tension& tension, Stiffness stiffness, Mat3* lower);

/// For limits of steps: the positive part of tension that is strained by `margin` [-] more than it is, pulled
/// or not, and pulls as where it is stretched. So a limit holds until the strain has grown by that much.
inline constexpr double tension_margin = 0.05;
void add_tension_stiffness_bound(std::span<const Vec3> x, std::span<const Tension> tension,
                                 const BlockSink& sink, double margin = tension_margin);

/// Throws std::invalid_argument if it names a particle out of range or one twice, its rest length is not > 0,
/// or not 0 <= compress <= stretch, finite.
void check(const Tension& tension, std::size_t particles);

}  // namespace furrow::physics
