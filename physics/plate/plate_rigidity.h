// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>

namespace furrow::physics {

/// What a plate of cloth resists bending with [N m]. Strips are narrow: their borders are free, so a strip is
/// limper than a wide sheet that is rolled. Warp and weft are at right angles at rest.
struct PlateRigidity {
  double warp, weft;   ///< B1, B2 of strips cut along warp and weft; > 0, or all three 0
  double twist;        ///< B_t; > 0
  double poisson = 0;  ///< nu12: a strip along warp, bent by K, bends across by -nu12 K; nu12^2 < B1 / B2
};
/// The same in all directions: B_t = B / (2 (1 + nu)). B >= 0 [N m]; nu in (-1, 1). Throws
/// std::invalid_argument otherwise.
PlateRigidity isotropic_plate(double rigidity, double poisson = 0);
/// B_t [N m] of a cloth whose strips cut at 45 degrees have the rigidity `bias` [N m]:
/// 1 / (4 / B45 - 1 / B1 - 1 / B2 + 2 nu12 / B1). Throws std::invalid_argument if there is none > 0.
double twist_of_bias(double warp, double weft, double bias, double poisson = 0);

/// D [N m], the energy of an area being 1/2 k^T D k with the curvatures k = (K11, K22, 2 K12) [1/m] in axes
/// that the warp leads by `angle` [rad]. Throws std::invalid_argument if D is not positive definite and not
/// 0.
Eigen::Matrix3d plate_matrix(const PlateRigidity& plate, double angle);

}  // namespace furrow::physics
