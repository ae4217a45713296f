// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <array>

#include "physics/base/arrays.h"
#include "physics/cloth/stiffness.h"

namespace furrow::physics {

/// The signed angle theta [rad] between two triangles (0, 1, 2) and (1, 0, 3) at their edge 0-1, and its
/// derivatives. With the triangles' normals n_A, n_B and the unit edge e
///   theta = atan2((n_A x n_B) . e, n_A . n_B)   in (-pi, pi]:  0 flat, > 0 a ridge seen from the normals'
///   side.
/// It jumps by 2 pi where the flaps lie on each other; its derivatives do not.
/// For a flap with normal n over the edge of length l, the tip has  dtheta/dx = -l n / |n|^2  (length
/// 1/height); the edge's ends balance it by the foot's share, so that rigid motions leave theta as it is.
/// Where the edge has no length or a flap no area (product of squares below 1e-280) all derivatives are 0.
struct Dihedral {
  double angle;
  std::array<Vec3, 4> gradient;  ///< [1/m]
};

double dihedral_angle(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3);
Dihedral dihedral(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3);
/// Second derivative of theta [1/m^2], closed form: the derivative of the gradient, flap by flap; its blocks
/// on and below the diagonal. Symmetric.
std::array<Mat3, lower_blocks(4)> dihedral_hessian(const Vec3& x0, const Vec3& x1, const Vec3& x2,
                                                   const Vec3& x3);

}  // namespace furrow::physics
