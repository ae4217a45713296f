// SPDX-License-Identifier: MIT
#include "physics/pairs/pair_curvature.h"

#include <cmath>

namespace furrow::physics {
namespace {

constexpr double nearly_parallel = 1e-3;  // squared sine

/// Where the closest points can go: by each free parameter the way of the point of the second primitive
/// towards the first, and what it changes the weights by.
struct FreeParameters {
  int count = 0;
  std::array<Vec3, 2> way;
  std::array<std::array<double, 4>, 2> weights{};

  void add(const std::array<Vec3, 4>& x, int less, int more) {
    const auto k = std::size_t(count++);
    weights[k][std::size_t(less)] = -1;
    weights[k][std::size_t(more)] = 1;
    way[k] = x[std::size_t(more)] - x[std::size_t(less)];
  }
};

FreeParameters free_parameters(bool edges, const std::array<Vec3, 4>& x, const std::array<double, 4>& w) {
  FreeParameters free;
  if (edges) {
    if (w[0] != 0 && w[1] != 0) free.add(x, 0, 1);
    if (w[2] != 0 && w[3] != 0) free.add(x, 3, 2);
    return free;
  }
  int base = 0;
  for (const int corner : {1, 2, 3}) {
    if (w[std::size_t(corner)] == 0) continue;
    if (base > 0)
      free.add(x, corner, base);
    else
      base = corner;
  }
  return free;
}

}  // namespace

PairCurvature pair_curvature(bool edges, const std::array<Vec3, 4>& x, const std::array<double, 4>& weights) {
  const FreeParameters free = free_parameters(edges, x, weights);
  PairCurvature found;
  const auto& [p, q] = free.way;
  if (free.count == 1) {
    found.slide[0] = p / p.squaredNorm();
  } else if (free.count == 2) {
    const double a = p.squaredNorm(), b = p.dot(q), c = q.squaredNorm(), det = a * c - b * b;
    if (!(det > nearly_parallel * a * c)) return found;
    found.slide = {Vec3((c * p - b * q) / det), Vec3((a * q - b * p) / det)};
  }
  double of_weights = 0, of_slide = 0, of_tilt = 0;
  for (const double w : weights) of_weights += w * w;
  for (int k = 0; k < free.count; ++k) {
    of_slide += of_weights * found.slide[std::size_t(k)].squaredNorm();
    of_tilt += 2;
  }
  if (!(of_slide > 0) || !std::isfinite(of_slide)) return found;
  const double balance = std::sqrt(std::sqrt(of_tilt / of_slide));  // both parts of a row are as large then
  found.rows = free.count;
  for (std::size_t k = 0; k < std::size_t(free.count); ++k) {
    found.slide[k] *= balance;
    for (std::size_t i = 0; i < 4; ++i) found.tilt[k][i] = free.weights[k][i] / balance;
  }
  return found;
}

}  // namespace furrow::physics
