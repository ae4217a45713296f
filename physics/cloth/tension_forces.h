// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <span>
#include <tuple>

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

/// What elements.h asks of a kind.
inline std::array<int, 2> vertices(const Tension& t) { return {t.a, t.b}; }
inline void renumber(Tension& t, std::span<const int> place) { t.a = place[t.a], t.b = place[t.b]; }
inline auto fields(const Tension& t) { return std::tuple(t.a, t.b, t.rest_length, t.stretch, t.compress); }
/// Throws std::invalid_argument if it names a particle out of range or one twice, its rest length is not > 0,
/// or not 0 <= compress <= stretch, finite.
void check(const Tension& tension, std::size_t particles);
double energy(std::span<const Vec3> x, const Tension& tension);
/// On a  T n,  on b the opposite, none at length 0.
double add_forces(std::span<const Vec3> x, const Tension& tension, std::span<Vec3> force);
/// K = T' n n^T + T/l (I - n n^T).  Stiffness::positive_part leaves out the transverse part of what is
/// compressed (K >= exact). At rest K is 0.
void stiffness_blocks(std::span<const Vec3> x, const Tension& tension, Stiffness stiffness, Mat3* lower);

/// As edges that stretch: ends and rest length, and the stiffness that they are damped by [N/m].
inline std::array<Spring, 1> edges(const Tension& t) { return {Spring{t.a, t.b, t.rest_length, 0}}; }
inline std::array<double, 1> edge_stiffness(const Tension& t) { return {tension_slope(t, working_strain)}; }

/// For limits of steps: the positive part of tension that is strained by `margin` [-] more than it is, pulled
/// or not, and pulls as where it is stretched. So a limit holds until the strain has grown by that much.
inline constexpr double tension_margin = 0.05;
void stiffness_bound_blocks(std::span<const Vec3> x, const Tension& tension, Mat3* lower,
                            double margin = tension_margin);

}  // namespace furrow::physics
