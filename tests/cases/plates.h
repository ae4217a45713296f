// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include "physics/cloth/cloth.h"
#include "physics/plate/plate.h"
#include "tests/cases/flat_meshes.h"

namespace furrow::cases {

/// Plates of the flat meshes of flat_meshes.h.

/// The lengths of its triangles' edges, as the cloth lies.
std::vector<std::array<double, 3>> lengths_of(const physics::Cloth& cloth);
/// From each triangle's edge 0 -> 1 to a direction of the plane, `angle` [rad] from the x axis.
std::vector<double> warp_along(const physics::Cloth& cloth, double angle);
/// The plate over flat hinges of all inner edges. The cloth has triangles, pins and no hinges.
physics::PlateParts plate_of(const physics::Cloth& cloth, const physics::PlateRigidity& rigidity,
                             double warp_angle = 0);
/// Puts it into the cloth's energies, hinges that stay plain among its hinges.
void add_plate(physics::Cloth& cloth, const physics::PlateRigidity& rigidity, double warp_angle = 0);

/// B of a strip cut at `angle` [rad] to the warp [N m]:
/// 1 / B = c^4 / B1 + s^4 / B2 + (1 / B_t - 2 nu12 / B1) c^2 s^2.
double strip_rigidity(const physics::PlateRigidity& plate, double angle);

/// Triangles none of whose corners is within `rings` edges of the border.
std::vector<char> core_of(const physics::Cloth& cloth, int rings);
/// Of each particle, how many edges from the border.
std::vector<int> rings_from_border(const physics::Cloth& cloth);

/// A strip along +x, clamped at x = 0: the particles there are pinned, and behind each edge of theirs the tip
/// of one triangle. Membrane of Poisson's ratio 0; no hinges yet.
struct ClampedStrip {
  physics::Cloth cloth;
  std::vector<int> tip;  ///< particles at x = length, by y
  double length, width;  ///< [m]
  double density;        ///< [kg/m^2]
};
ClampedStrip clamped_strip(SheetKind kind, double length, double width, int columns, double young,
                           double density = 0.1);

}  // namespace furrow::cases
