// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

#include "physics/pairs/pair_mesh.h"

namespace furrow::physics {

/// Moves of cloth that is taken apart: each vertex goes a third of its shortest edge at once at most, and no
/// farther than `farthest` [m] from where it was. What is held stays. For untangle_layers(),
/// untangle_contours(). Private.
class TangleMoves {
 public:
  TangleMoves(std::span<Vec3> x, const PairMesh& mesh, double farthest);

  /// Half of its own way and half of the mean of its neighbours', five times.
  void smooth(std::vector<Vec3>& way) const;
  /// The longest way is scaled to `longest` [m].
  void go(const std::vector<Vec3>& way, double longest);
  void step(std::size_t i, Vec3 by);  ///< [m]
  /// Of vertices at other positions from where they were [m].
  double farthest_of(std::span<const Vec3> x) const;
  const std::vector<Vec3>& start() const { return start_; }

 private:
  void smooth_once(std::vector<Vec3>& way) const;

  std::span<Vec3> x_;
  const PairMesh& mesh_;
  double farthest_;
  std::vector<Vec3> start_;
  std::vector<double> shortest_;
};

}  // namespace furrow::physics
