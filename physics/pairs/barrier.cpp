// SPDX-License-Identifier: MIT
#include "physics/pairs/barrier.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace furrow::physics {
namespace {

constexpr double series_until = 0.02;    // 1 - u below which the logarithm would cancel
constexpr double parallel_until = 1e-3;  // squared sine below which edges count as nearly parallel

/// -ln(1 - r) - r - r^2 / 2.
double barrier_shape(double r) {
  if (r >= series_until) return -std::log1p(-r) - r - 0.5 * r * r;
  double sum = 0;
  for (int n = 11; n >= 3; --n) sum = sum * r + 1.0 / n;
  return sum * r * r * r;
}

}  // namespace

Barrier barrier(double distance, double range, double stiffness) {
  const double u = distance / range, r = 1 - u;
  if (!(r > 0)) return {0, 0, 0};
  if (!(u > 0)) {
    const double infinite = std::numeric_limits<double>::infinity();
    return {infinite, infinite, infinite};
  }
  return {0.5 * stiffness * range * range * barrier_shape(r), 0.5 * stiffness * range * r * r / u,
          0.5 * stiffness * (1 / (u * u) - 1)};
}

ParallelShare parallel_share(const Vec3& e1, const Vec3& e2, double lengths) {
  const double end = parallel_until * lengths * lengths, c = e1.cross(e2).squaredNorm();
  if (!(c < end)) return {};
  const double slope = 2 * (end - c) / (end * end), product = e1.dot(e2);
  return {c * (2 * end - c) / (end * end), 2 * slope * (e2.squaredNorm() * e1 - product * e2),
          2 * slope * (e1.squaredNorm() * e2 - product * e1)};
}

}  // namespace furrow::physics
