// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include "physics/cloth/cloth.h"
#include "tests/cases/flat_meshes.h"

namespace furrow::cases {

/// The slit annular plate under a lifting line load (Sze, Liu and Lo 2004, Popular benchmark problems for
/// geometric nonlinear analysis of shells, Finite Elements in Analysis and Design 40): radii 6 and 10, E =
/// 21e6, nu = 0, thickness 0.03, clamped at one side of the slit, at the other lifted by 0.8 a length at full
/// load.
struct SlitAnnulus {
  physics::Cloth cloth;      ///< in the plane z = 0, with membrane and plate
  std::vector<int> lifted;   ///< particles of the free side, from the inner radius to the outer
  std::vector<double> load;  ///< of each, at full load along z [N]
};
/// The lifts of the inner and the outer corner of the free side at shares of the full load, as they tabulate
/// them of fine meshes of shells.
struct AnnulusLift {
  double share, inner, outer;
};
inline constexpr AnnulusLift annulus_lifts[] = {{0.1, 4.277, 5.876},
                                                {0.3, 8.340, 11.213},
                                                {0.5, 10.468, 13.768},
                                                {0.8, 12.642, 16.202},
                                                {1.0, 13.891, 17.528}};

/// columns quads around, rows across, cut as the kind says; equilateral and jittered: rows of triangles, even
/// or with 0.2 cells of jitter. one_diagonal, by_row, union_jack, cut_jittered, equilateral or jittered;
/// throws std::invalid_argument for another. patches: the membrane is joined (join_patches()).
SlitAnnulus slit_annulus(SheetKind kind, int columns, int rows, bool patches);

struct AnnulusRest {
  double inner, outer;  ///< lifts
  int iterations = 0, factorisations = 0;
  bool converged = false;
};
/// Goes on to rest at a share of the full load from where it is.
AnnulusRest lift(SlitAnnulus& annulus, double share);

}  // namespace furrow::cases
