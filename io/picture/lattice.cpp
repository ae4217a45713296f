// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/lattice.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace furrow::io {
namespace {

/// Lagrange's reduction: the two shortest vectors that span the lattice of (1, generator) and (0, points).
std::pair<Eigen::Vector2d, Eigen::Vector2d> shortest_steps(int points, int generator) {
  Eigen::Vector2d a(1, generator), b(0, points);
  while (true) {
    if (a.squaredNorm() > b.squaredNorm()) std::swap(a, b);
    const double times = a.dot(b) / a.squaredNorm();
    if (std::abs(times) <= 0.5) return {a, b};  // at 0.5 another step would only turn it round
    b -= std::round(times) * a;
  }
}

}  // namespace

Lattice::Lattice(int points) : points_(points) {
  if (points < 1 || points > 1024)
    throw std::invalid_argument("lattice: points " + std::to_string(points) + " is not in [1, 1024]");
  double widest = 0;
  for (int g = 1; g <= points; ++g) {
    const auto [a, b] = shortest_steps(points, g);
    if (!(a.squaredNorm() > widest)) continue;
    widest = a.squaredNorm();
    generator_ = g;
    steps_[0] = a / points;
    steps_[1] = b / points;
  }
}

Eigen::Vector2d Lattice::point(int i, double u, double v) const {
  const Eigen::Vector2d p = Eigen::Vector2d(i, i * generator_) / points_ + u * steps_[0] + v * steps_[1];
  return {p.x() - std::floor(p.x()), p.y() - std::floor(p.y())};
}

}  // namespace furrow::io
