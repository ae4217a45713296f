// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/mesh.h"
#include "physics/particles.h"

namespace furrow::cli {

/// How far two shapes of one garment are apart, each as a share of the garment's size [-].
struct ShapeDistance {
  double rms = 0;   ///< of the vertices, weighted with their masses
  double max = 0;   ///< of the farthest vertex
  double bulk = 0;  ///< of what a chaotic motion still determines: see ShapeMeter
};

/// Measures shapes of one garment against each other. The bulk of a shape is its centre of mass, its mean
/// distance (RMS) from that, and of each border loop the centre and the mean distance from it; two shapes'
/// bulks are apart by the largest difference of any.
class ShapeMeter {
 public:
  /// Size: the diagonal of the box of `particles`, > 0 [m]. Vertices without mass do not count.
  ShapeMeter(const geometry::Mesh& mesh, const physics::Particles& particles);
  double size() const { return size_; }
  /// Cost: O(vertices). Of shapes that are not finite: infinity.
  ShapeDistance between(const std::vector<physics::Vec3>& a, const std::vector<physics::Vec3>& b) const;

 private:
  struct Ball {
    physics::Vec3 centre;  ///< [m]
    double radius;         ///< RMS distance from it [m]
  };
  std::vector<Ball> bulk(const std::vector<physics::Vec3>& x) const;

  std::vector<double> mass_;
  std::vector<std::vector<int>> groups_;  ///< all vertices with mass, then each border loop
  double size_;
};

}  // namespace furrow::cli
