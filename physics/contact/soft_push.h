// SPDX-License-Identifier: MIT
#pragma once

namespace furrow::physics {

/// How a body pushes a point that is d > 0 deep in its gap: harder and harder over the soft layer, as a
/// spring below it.
struct SoftPush {
  double energy, force, stiffness;  ///< [J], [N], [N/m]
};

/// `stiffness` k [N/m], `soft` s [m]: energy k d^3 / (6 s) for d < s, else k (d^2 / 2 - s d / 2 + s^2 / 6).
inline SoftPush soft_push(double d, double k, double s) {
  if (!(d > 0)) return {0, 0, 0};
  if (d < s) return {k * d * d * d / (6 * s), 0.5 * k * d * d / s, k * d / s};
  return {k * (0.5 * d * d - 0.5 * s * d + s * s / 6), k * (d - 0.5 * s), k};
}

}  // namespace furrow::physics
