// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>

#include "tests/cases/membrane_laws.h"

namespace furrow::cases {

/// What carries the plane of a cloth: springs of a law, or (none) constant-strain triangles with nu = 1/3.
using Carrier = std::optional<MembraneLaw>;

/// The answers to one affine displacement of the border.
struct PatchAnswer {
  double energy;      ///< over that of a membrane with Y and nu = 1/3 [-]
  double non_affine;  ///< farthest that a vertex lies from its affine place, over strain times h [-]
};
struct PatchScore {
  PatchAnswer dilation;  ///< u = (x, y)
  PatchAnswer stretch;   ///< u = (x, -y), pure shear along the axes
  PatchAnswer slide;     ///< u = (y, x), pure shear at 45 degrees
  double dt_limit;       ///< 2 / omega_max of the plane, all vertices free, over h sqrt(rho / Y) [-]
};

/// Membrane patch test: border vertices are displaced affinely, the inside is at rest, strain is small
/// (linear). Spring laws are calibrated so that they answer the affine dilation exactly
/// (calibrated_stiffness). sheet: a mesh of flat_meshes.h at rest, whose border is that of the square or
/// rectangle; columns: width / h. Cost: one sparse factorisation.
PatchScore patch_test(physics::Cloth sheet, int columns, const Carrier& carrier);

}  // namespace furrow::cases
