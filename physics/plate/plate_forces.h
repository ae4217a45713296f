// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

#include "physics/base/vec4.h"
#include "physics/plate/plate.h"

namespace furrow::physics {

/// A plate laid out for speed: hinges four at a time, the last four filled up with copies that nobody reads.
class PlateLayout {
 public:
  explicit PlateLayout(const Plate& plate);
  /// Takes over its `at_rest`; the rest must be that of the plate given before.
  void put_at_rest(const Plate& plate);

  /// The plate's energy at x [J]; adds its forces -dE/dx [N] to `force`, unless that is empty. One position a
  /// particle. Cost: five divisions and two square roots a hinge, no allocation after a thread's first call.
  /// Same bits on every machine; the formulas are those of dihedral.h.
  double add_forces(std::span<const Vec3> x, std::span<Vec3> force) const;

  struct alignas(32) FourHinges {
    double rest_angle[4];
    int vertex[4][4];
  };
  struct alignas(32) Answer {
    Vec4 column[3];  ///< of area times D
    Vec4 at_rest{};  ///< [1/m]
  };

 private:
  std::vector<FourHinges> hinges_;
  std::vector<Answer> answers_;  ///< of each triangle
  std::vector<int> begin_, hinge_;
  std::vector<Vec4> share_;  ///< of each entry
};

}  // namespace furrow::physics
