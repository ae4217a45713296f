// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <vector>

namespace furrow::physics {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// Mass points. All arrays have one entry a particle.
struct Particles {
  std::vector<Vec3> x;           ///< positions [m]
  std::vector<Vec3> v;           ///< velocities [m/s]
  std::vector<double> mass;      ///< [kg]; > 0, but 0 for a vertex that no face uses
  std::vector<double> inv_mass;  ///< [1/kg]; 0 = pinned: it moves only as World::pins leads it

  std::size_t size() const { return x.size(); }
};

}  // namespace furrow::physics
