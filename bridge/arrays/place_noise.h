// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <vector>

#include "physics/base/arrays.h"

namespace furrow::bridge {

/// A smooth random field in space, the same for every mesh that lies there: 64 plane waves whose directions,
/// lengths and phases are hashed from a seed. Its root mean square is 1, its largest value about 4.
/// \details Wavelengths lie between 1/40 and 1/5 of the box's diagonal, spread evenly over their logarithms:
/// on a shirt 3 to 25 cm, the folds of cloth. It is tied to the box's lowest corner, so it moves with a
/// garment, and does not turn with it. Evaluation costs 64 cosines.
class PlaceNoise {
 public:
  /// The box of these positions [m]; none, or all at one place: the field is 0.
  PlaceNoise(const std::vector<physics::Vec3>& positions, std::uint64_t seed);
  double operator()(const physics::Vec3& x) const;  ///< [-]
  double diagonal() const { return diagonal_; }     ///< of the box [m]

 private:
  struct Wave {
    physics::Vec3 k;  ///< [1/m]
    double phase;     ///< [rad]
  };
  physics::Vec3 corner_ = physics::Vec3::Zero();
  double diagonal_ = 0;
  std::vector<Wave> waves_;
};

}  // namespace furrow::bridge
