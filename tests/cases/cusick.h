// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "physics/cloth/cloth.h"

namespace furrow::cases {

/// Cusick's drape test (ISO 9073-9): a round specimen is held flat between two smaller discs, and what stands
/// out hangs down in folds. Only the bending length c = (B / weight an area)^(1/3) and the sizes count as
/// long as the cloth hardly stretches.
struct CusickOptions {
  double radius = 0.15;   ///< of the specimen [m]; > support
  double support = 0.09;  ///< radius of the discs [m]; > 0
  int rings = 20;         ///< of the mesh; >= 2, one lies on the discs' edge: rings support / radius is whole
  double density = 0.18;  ///< [kg/m^2]; > 0
  double bending_length = 0.02;  ///< c [m]; > 0; hinges have B = c^3 density g
  double young = 450;            ///< times thickness [N/m]; > 0
  double poisson = 0.3;          ///< [-]; in (-1, 1)
  physics::HingeLaw law = physics::HingeLaw::linear;
  bool stiff_clamp = true;  ///< hinges on the discs' edge count twice (pins.h: stiffen_clamps)
  bool plate = false;       ///< in place of hinges; it is clamped by itself
  bool patches = false;     ///< the membrane is joined (join_patches())
  double jitter = 0;        ///< free particles within the rim move by up to so many h in x and y; in [0, 0.3]
  int folds = 7;            ///< in the start; >= 0
  double slope = 0.2;       ///< of the start outside the discs, and as much of its folds [-]
};
inline constexpr double cusick_gravity = 9.81;  ///< along -z [m/s^2]

struct Cusick {
  physics::Cloth cloth;  ///< particles within the discs, their edge too, are pinned at z = 0
  std::vector<int> rim;  ///< particles of the specimen's border, counter-clockwise
  double radius, support;
};
/// A mesh of rings (flat_meshes.h: disc), constant-strain triangles, hinges flat at rest. It starts as a cone
/// with folds, z = -slope (r - support) (1 + cos(folds angle)). A ring must lie on the edge: otherwise the
/// cloth would be clamped elsewhere than it is held, and the result wrong by a tenth. Throws
/// std::invalid_argument.
Cusick cusick_specimen(const CusickOptions& options);

/// Area of the shadow that the cloth casts along z [m^2]: that of the union of its triangles, on `lines`
/// lines, exact along them. Cost: triangles x lines / diameter in triangles.
double shadow_area(const physics::Cloth& cloth, int lines = 2000);

/// DC = (shadow - discs) / (specimen - discs) [-]: 1 for a stiff specimen, 0 for one that hangs straight
/// down.
double drape_coefficient(const Cusick& specimen);

/// Number of folds: the strongest harmonic, 2 to 20, of the rim's distance from the axis over the particles.
int drape_nodes(const Cusick& specimen);

/// Elastic energy plus weight, 0 for the flat specimen [J].
double drape_energy(const Cusick& specimen);

}  // namespace furrow::cases
