// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>

namespace furrow::io {

/// Points that fill the unit square evenly: the rank-1 lattice of so many points whose nearest two, the
/// square repeated, are farthest apart. Shifted by u · step[0] + v · step[1], u and v in [0, 1), it takes
/// every place that it can, once: so a sum over it changes slowly with u and v, and blue noise in them stays
/// blue in the sum.
class Lattice {
 public:
  /// Cost: points² for the search. Throws std::invalid_argument unless 1 ≤ points ≤ 1024.
  explicit Lattice(int points);

  /// Point `i` in [0, points), shifted: in [0, 1)².
  Eigen::Vector2d point(int i, double u, double v) const;

  int points() const { return points_; }
  const Eigen::Vector2d& step(int k) const { return steps_[k]; }

 private:
  int points_, generator_ = 1;
  Eigen::Vector2d steps_[2];  ///< two shortest vectors that span it
};

}  // namespace furrow::io
