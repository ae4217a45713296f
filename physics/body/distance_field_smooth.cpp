// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>

#include "physics/body/distance_field.h"

namespace furrow::physics {
namespace {

constexpr double widest = 1e-4;  // m

/// An interval around a coordinate, split at a lattice plane that crosses it.
struct Pieces {
  int count = 1;
  std::array<double, 2> middle{}, share{1, 0};
};

Pieces pieces_of(double x, double half, double low, double cell) {
  const double plane = low + std::round((x - low) / cell) * cell;
  if (!(std::abs(plane - x) < half)) return {1, {x, 0}, {1, 0}};
  const double below = (plane - (x - half)) / (2 * half);
  return {2, {0.5 * (x - half + plane), 0.5 * (x + half + plane)}, {below, 1 - below}};
}

}  // namespace

SignedDistance DistanceField::smooth_at(const Vec3& x) const {
  const double cell = 1 / per_unit_, half = 0.5 * std::min(widest, 0.5 * cell);
  std::array<Pieces, 3> p;
  for (int k = 0; k < 3; ++k) p[k] = pieces_of(x[k], half, low_[k], cell);
  if (p[0].count * p[1].count * p[2].count == 1) return at(x);
  SignedDistance mean{0, Vec3::Zero()};
  for (int a = 0; a < p[0].count; ++a)
    for (int b = 0; b < p[1].count; ++b)
      for (int c = 0; c < p[2].count; ++c) {
        const double share = p[0].share[a] * p[1].share[b] * p[2].share[c];
        const SignedDistance d = at({p[0].middle[a], p[1].middle[b], p[2].middle[c]});
        mean.value += share * d.value;
        mean.gradient += share * d.gradient;
      }
  return mean;
}

}  // namespace furrow::physics
