// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include "physics/base/arrays.h"

namespace furrow::physics {

/// Sum of the products of two vectors of one entry a particle, of the same length, in the particles' order.
inline double dot(std::span<const Vec3> a, std::span<const Vec3> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

/// sum += factor * v, of the same length.
inline void add_multiple(std::span<Vec3> sum, double factor, std::span<const Vec3> v) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += factor * v[i];
}

}  // namespace furrow::physics
