// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/mesh/mesh.h"
#include "jobs/move/chart.h"
#include "physics/cloth/cloth.h"

namespace furrow::jobs {

/// A cloth at some time.
struct Shape {
  std::vector<physics::Vec3> x;  ///< [m]; empty: unknown
  double energy = 0;             ///< of elements, weight and motion [J], up to the same constant
};

/// Measures shapes of one garment against each other.
class ShapeMeter {
 public:
  /// Size: the diagonal of the box of the particles, > 0 [m]. Vertices without mass do not count. Energies
  /// are divided by the weight (with 9.81 m/s^2 where gravity is 0) to be lengths.
  ShapeMeter(const geometry::Mesh& mesh, const physics::Cloth& cloth, const physics::Vec3& gravity);
  double size() const { return size_; }
  Shape shape_of(physics::Cloth cloth) const;
  /// Cost: two exact closest points a vertex, about 2 us. Of shapes that are not finite: infinity.
  ShapeDistance between(const Shape& a, const Shape& b) const;

 private:
  struct Ball {
    physics::Vec3 centre;  ///< [m]
    double radius;         ///< RMS distance from it [m]
  };
  std::vector<Ball> balls(const std::vector<physics::Vec3>& x) const;
  double to_surface(const std::vector<physics::Vec3>& x, const std::vector<physics::Vec3>& surface) const;

  std::vector<double> mass_;  ///< rest area times density
  std::vector<std::array<int, 3>> triangles_;
  std::vector<std::vector<int>> groups_;  ///< all vertices with mass, then each border loop
  physics::Vec3 gravity_;
  double size_, weight_;
};

}  // namespace furrow::jobs
