// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

#include "physics/base/arrays.h"
#include "physics/cloth/packed_energy.h"
#include "physics/plate/plate.h"

namespace furrow::physics {

/// A plate laid out for speed: hinges and triangles four at a time. The last hinges are filled up with copies
/// that no triangle reads, triangles with entries of no share.
class PlateLayout : public PackedEnergy {
 public:
  /// place: of each particle; empty: its number. Hinges and triangles are sorted by place.
  explicit PlateLayout(const Plate& plate, std::span<const int> place = {});
  /// Takes over its `at_rest`; the rest must be that of the plate given before.
  void put_at_rest(const Plate& plate);

  /// The plate's energy at x [J]; adds its forces -dE/dx [N] to `force`, unless that is empty or null. Cost:
  /// five divisions and two square roots a hinge, no allocation after a thread's first call. Same bits on
  /// every machine; the formulas are those of dihedral.h.
  double add_forces(std::span<const Vec3> x, std::span<Vec3> force) const;
  double add_forces(const Vec4* x, Vec4* force) const override;

  struct alignas(32) FourHinges {
    double rest_angle[4];
    int vertex[4][4];
  };
  /// What a bend adds to the curvatures of four triangles: (K11, K22, 2 K12), one triangle a lane.
  struct alignas(32) FourShares {
    double share[3][4];
    int hinge[4];
  };
  struct alignas(32) FourTriangles {
    double stiffness[6][4];  ///< of area times D: 11, 22, 33, 12, 13, 23
    double at_rest[3][4];    ///< [1/m]
    int begin, end;          ///< of its shares
  };

 private:
  void lay_out_triangles(const Plate& plate, const std::vector<int>& place_of_hinge);

  std::vector<FourHinges> hinges_;
  std::vector<FourTriangles> triangles_;
  std::vector<FourShares> shares_;
  std::vector<int> lane_of_;  ///< of each triangle of the plate: four times its group, and its lane
};

}  // namespace furrow::physics
