// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <span>
#include <tuple>

#include "physics/cloth/cloth.h"
#include "physics/cloth/stiffness.h"

namespace furrow::physics {

/// A hinge's law at phi = theta - rest_angle, brought into (-pi, pi] by a full turn where needed: so the
/// moment jumps only opposite the rest angle, where the hinge may fall back either way; where theta itself
/// jumps (flaps folded onto each other) the moment is continuous unless the rest angle is 0.
///   linear: E = k phi^2 / 2;   cosine (Hanami and Tokoi): E = k (|phi| - sin |phi|), with
/// moment  k (1 - cos phi) sign phi  and no stiffness at rest.
struct HingeMoment {
  double energy, moment, curvature;  ///< E [J], dE/dphi [N m], d2E/dphi2 [N m], >= 0
};
HingeMoment hinge_moment(HingeLaw law, double stiffness, double phi);
/// theta - rest_angle in (-pi, pi].
double bend(double theta, double rest_angle);

/// Stiffness of a linear hinge [N m] for a plate of bending rigidity B [N m]:  factor B l^2 / (A1 + A2)  with
/// the rest length l [m] of the edge and the rest areas [m^2] of the triangles beside it (Grinspun et al.
/// 2003 scale it so; this constant gives E = 1/2 B l^2/(A1 + A2) theta^2). factor: 2 for hinges at a clamped
/// edge. Throws std::invalid_argument unless B >= 0, l > 0, A1 + A2 > 0, factor >= 0.
double hinge_stiffness(double rigidity, double length, double area1, double area2, double factor = 1);

/// What elements.h asks of a kind; the law is all hinges'.
inline std::array<int, 4> vertices(const Hinge& h) { return h.vertices; }
inline void renumber(Hinge& h, std::span<const int> place) {
  for (int& v : h.vertices) v = place[v];
}
inline auto fields(const Hinge& h) {
  const auto& [a, b, left, right] = h.vertices;
  return std::tuple(a, b, left, right, h.rest_angle, h.stiffness);
}
/// Throws std::invalid_argument if it names a particle out of range or one twice, its rest angle is not in
/// [-pi, pi] or its stiffness not >= 0.
void check(const Hinge& hinge, std::size_t particles);
double energy(std::span<const Vec3> x, const Hinge& hinge, HingeLaw law);
/// -dE/dtheta dtheta/dx, in total without force or moment: tips pushed along the flaps' normals, the edge
/// takes the reaction.
double add_forces(std::span<const Vec3> x, const Hinge& hinge, HingeLaw law, std::span<Vec3> force);
/// Stiffness::exact: E'' g g^T + E' d2theta/dx2; positive_part: E'' g g^T alone (Gauss and Newton's), g the
/// gradient of theta: semidefinite, equal at rest, but not >= exact where a hinge is bent.
void stiffness_blocks(std::span<const Vec3> x, const Hinge& hinge, HingeLaw law, Stiffness stiffness,
                      Mat3* lower);
/// For limits of steps: exact, but with the law's largest E'' (that is k), so that a cosine hinge counts
/// before it bends.
void stiffness_bound_blocks(std::span<const Vec3> x, const Hinge& hinge, HingeLaw law, Mat3* lower);

}  // namespace furrow::physics
