// SPDX-License-Identifier: MIT
#pragma once
#include "physics/base/lanes_geometry.h"

namespace furrow::physics {

/// dihedral.h's angle of four hinges at once, one a lane: the same formulas. The gradient at the tip of a
/// flap is `tip`; `foot` is where its foot lies on the edge, as a share of it, from the flap's first end.
struct FourBends {
  Vectors tip_a, tip_b;  ///< d theta / dx [1/m]; 0 where the edge or a flap has collapsed
  Lanes foot_a, foot_b;  ///< [-]
  Lanes angle;           ///< [rad]
};

FURROW_INLINE void bends_of(const int (&vertex)[4][4], const Vec4* x, FourBends& b) {
  const Vectors x0 = gathered(x, vertex[0]), x1 = gathered(x, vertex[1]);
  const Vectors e = x1 - x0, f = gathered(x, vertex[2]) - x0, g = gathered(x, vertex[3]) - x1;
  const Vectors na = cross(e, f), nb = cross(g, e);
  Lanes l2, a2, b2, fe, ge, l, sine, cosine;
  dot(e, e, l2), dot(na, na, a2), dot(nb, nb, b2), dot(f, e, fe), dot(g, e, ge);
  square_root(l2, l);
  dot(cross(na, nb), e, sine), dot(na, nb, cosine);
  const Lanes zero{}, one = zero + 1;
  const auto exists = (l2 * a2 > zero + 1e-280) & (l2 * b2 > zero + 1e-280);
  const Lanes inv = one / (exists ? l2 : one);
  b.foot_a = fe * inv, b.foot_b = -(ge * inv);
  b.tip_a = scaled(exists ? -l / (exists ? a2 : one) : zero, na);
  b.tip_b = scaled(exists ? -l / (exists ? b2 : one) : zero, nb);
  arc_tangent(exists ? sine * (l * inv) : zero, exists ? cosine : zero, b.angle);
}

/// theta - rest_angle in (-pi, pi].
FURROW_INLINE void bend_of(const Lanes& angle, const Lanes& rest_angle, Lanes& phi) {
  constexpr double pi = std::numbers::pi;
  const Lanes zero{}, raw = angle - rest_angle;
  phi = raw > zero + pi ? raw - 2 * pi : (raw <= zero - pi ? raw + 2 * pi : raw);
}

}  // namespace furrow::physics
