// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "physics/cloth/cloth.h"

namespace furrow::cases {

/// A ribbon of length 1 m and width W along y, its ends clamped straight, twisted by theta and stretched by
/// end_strain. tau = theta W / (2 L).
struct Twist {
  double tau = 0.1, end_strain = 0.01;  ///< [-]
};
struct RibbonLoad {
  double force;   ///< F / (Y W) [-]
  double torque;  ///< M / (Y W W/2) [-]
};

enum class FibreStrain { engineering, green };
/// A ribbon of longitudinal fibres that lie on helices and do not touch, with lambda = sqrt((1 + eps)^2 +
/// (tau s)^2) of the fibre at s W/2 and share = 1 - 1/lambda (springs) or (lambda^2 - 1)/2 (membrane
/// triangles): F/(Y W) = int_0^1 share (1 + eps) ds, M/(Y W W/2) = int_0^1 share tau s^2 ds.
RibbonLoad fibre_ribbon(const Twist& twist, FibreStrain strain = FibreStrain::engineering);

/// Fibres of springs on a helicoid, `fibres` of them at the middles of equal strips, `rows` springs each.
/// Returns what a cross-section in the middle carries.
RibbonLoad spring_ribbon(const Twist& twist, int fibres, int rows);

/// A ribbon of membrane triangles with Poisson's ratio 0 and a little bending (so that slack or compressed
/// parts have some stiffness), at the rest that Newton finds from the helicoid. width: W [m]. Returns what
/// the clamps carry. It differs from fibres in Green's strain by the hold that neighbours have on each other.
/// Throws std::runtime_error if no rest is found.
RibbonLoad membrane_ribbon(const Twist& twist, double width, int columns, int rows);

}  // namespace furrow::cases
