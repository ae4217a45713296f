// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <numbers>

#include "physics/base/lanes.h"

namespace furrow::physics {

/// Four vectors at once, one a lane.
struct Vectors {
  Lanes x, y, z;
};
FURROW_INLINE Vectors operator-(const Vectors& a, const Vectors& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
FURROW_INLINE Vectors operator+(const Vectors& a, const Vectors& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
FURROW_INLINE Vectors scaled(const Lanes& s, const Vectors& a) { return {s * a.x, s * a.y, s * a.z}; }
FURROW_INLINE Vectors cross(const Vectors& a, const Vectors& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
FURROW_INLINE void dot(const Vectors& a, const Vectors& b, Lanes& result) {
  result = a.x * b.x + a.y * b.y + a.z * b.z;
}
FURROW_INLINE void square_root(const Lanes& a, Lanes& root) {
  for (int j = 0; j < 4; ++j) root[j] = std::sqrt(a[j]);
}

FURROW_INLINE Vectors gathered(const Vec4* p, const int* index) {
  const Vec4 &a = p[index[0]], &b = p[index[1]], &c = p[index[2]], &d = p[index[3]];
  return {Lanes{a.x, b.x, c.x, d.x}, Lanes{a.y, b.y, c.y, d.y}, Lanes{a.z, b.z, c.z, d.z}};
}
/// Lane j goes to slot[j * stride].
FURROW_INLINE void scattered(const Vectors& v, Vec4* slot, int stride) {
  for (int j = 0; j < 4; ++j) *(Lanes*)(slot + j * stride) = Lanes{v.x[j], v.y[j], v.z[j], 0};
}

/// As std::atan2 within 9e-16, four at once and the same bits on every machine; 0 where both are 0. Rational
/// approximation of Moshier's Cephes (atan.c), its three ranges chosen before the one division for the
/// argument.
FURROW_INLINE void arc_tangent(const Lanes& y, const Lanes& x, Lanes& angle) {
  constexpr double pi = std::numbers::pi;
  const Lanes zero{}, pi4 = zero + pi / 4, pi2 = zero + pi / 2, one = zero + 1;
  const Lanes ay = y < zero ? -y : y, ax = x < zero ? -x : x;
  const auto steep = ay > 2.41421356237309504880 * ax, middle = ay > 0.66 * ax;
  const Lanes above = steep ? -ax : (middle ? ay - ax : ay), below = steep ? ay : (middle ? ay + ax : ax);
  const Lanes t = above / (below == zero ? one : below), z = t * t;
  const Lanes p =
      (((-8.750608600031904122785e-1 * z - 1.615753718733365076637e1) * z - 7.500855792314704667340e1) * z -
       1.228866684490136173410e2) *
          z -
      6.485021904942025371773e1;
  const Lanes q =
      ((((z + 2.485846490142306297962e1) * z + 1.650270098316988542046e2) * z + 4.328810604912902668951e2) *
           z +
       4.853903996359136964868e2) *
          z +
      1.945506571482613964425e2;
  const Lanes first = (t * (z * p / q) + t) + (steep ? pi2 : (middle ? pi4 : zero));
  const Lanes half = x < zero ? pi - first : first;
  angle = y < zero ? -half : half;
}

}  // namespace furrow::physics
