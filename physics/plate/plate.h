// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "physics/plate/plate_net.h"
#include "physics/plate/plate_rigidity.h"

namespace furrow::physics {

/// A plate over hinges: one curvature a triangle, k = sum of share times bend over its hinges (Voigt: K11,
/// K22, 2 K12; > 0 as a ridge seen from the normals' side), and the energy  E = 1/2 sum of (k - at_rest)^T
/// stiffness (k - at_rest). Constant; a bend is theta - rest_angle. Zero energy only where no hinge is bent.
struct Plate {
  std::vector<Hinge> hinges;  ///< as they were, sides and rest angles; `stiffness` is the plain hinge's
  std::vector<int> begin;     ///< of each triangle that bends its first entry below, and the end
  std::vector<int> hinge;     ///< of each entry
  std::vector<Eigen::Vector3d> share;      ///< of each entry [1/m]
  std::vector<Eigen::Matrix3d> stiffness;  ///< of each triangle: area times D, free borders condensed [N m^3]
  std::vector<double> area;                ///< of each triangle [m^2]
  std::vector<Eigen::Vector3d> at_rest;    ///< k of each triangle at rest [1/m]; empty: 0

  int triangles() const { return int(stiffness.size()); }
};

struct PlateOptions {
  PlateRigidity rigidity;
  /// From each triangle's edge 0 -> 1 to the warp, counter-clockwise [rad]; empty: 0, for a plate that is the
  /// same in all directions.
  std::span<const double> warp = {};
};

/// What make_plate() made of a sheet.
struct PlateParts {
  Plate plate;
  std::vector<int> coupled, plain;  ///< hinges of the sheet: those of the plate, in its order, and the others
  std::vector<int> triangles;       ///< of the sheet: those of the plate's rows
  int slivers = 0;                  ///< triangles whose slopes are shared out by area alone
};

/// The plate over the hinges of a sheet with these pins: exact for quadratic surfaces on every mesh, in
/// energy and in equilibrium, to 2e-5; free borders without moment; where the triangle beyond an edge is held
/// the edge is a clamp. Morley's triangle, its slopes reconstructed from the hinges around. Build it anew
/// when pins change (a clamp is part of it) or rest lengths do. Which hinges stay plain: plate_net().
/// Cost: some 3 us an edge. Throws std::invalid_argument as plate_net() and plate_matrix(), and if warp is
/// not one angle a triangle.
PlateParts make_plate(const PlateSheet& sheet, const PlateOptions& options);

}  // namespace furrow::physics
