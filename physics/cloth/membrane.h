// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <span>

#include "physics/cloth/cloth.h"
#include "physics/cloth/stiffness.h"

namespace furrow::physics {

/// Lame parameters of a sheet [N/m].
struct PlaneLame {
  double lambda, mu;
};
/// Plane stress:  lambda = Y nu / (1 - nu^2),  mu = Y / (2 (1 + nu)).  Y: Young's modulus times thickness
/// [N/m], >= 0; nu: Poisson's ratio [-], in (-1, 1). Throws std::invalid_argument otherwise.
PlaneLame plane_stress(double young_times_thickness, double poisson);

/// What a triangle's rest state comes to. With d_i = l_i^2 - L_i^2 of the edge opposite corner i, rest angles
/// a_i and rest area A the strain of Green has
///   tr E = sum d_i cot a_i / (4 A),   det E = (2 (d0 d1 + d1 d2 + d2 d0) - sum d_i^2) / (64 A^2),
/// so the energy  W = A ((lambda/2 + mu) (tr E)^2 - 2 mu det E) = 1/2 d^T H d  has a constant H.
struct MembraneConstants {
  double area;                ///< A [m^2]
  Eigen::Vector3d length2;    ///< L^2 [m^2]
  Eigen::Matrix3d quadratic;  ///< H [N/m^3]; positive semidefinite
};
/// Throws std::invalid_argument if the lengths make no triangle, or a parameter is not in its range.
MembraneConstants membrane_constants(const MembraneTriangle& triangle);

/// Second derivative of W by the length of edge i with the other two held, at rest: 4 L_i^2 H_ii [N/m].
/// Summed over an edge's triangles it is the spring that the edge resembles.
double edge_stiffness(const MembraneConstants& constants, int edge);

/// As the functions of springs do: energy [J], forces [N], blocks of K [N/m] of each triangle's corners in
/// order, (0, 0), (0, 1) ... (2, 2). The tension of an edge is 2 dW/dd times its vector.
/// Stiffness::positive_part clamps the eigenvalues of the part that the tensions make (K >= exact); the other
/// part is semidefinite. Cost: one pass. Throw std::invalid_argument, nothing changed, if lengths differ, a
/// triangle names a particle out of range, or as membrane_constants() does.
double membrane_energy(std::span<const Vec3> x, std::span<const MembraneTriangle> triangles);
void add_membrane_forces(std::span<const Vec3> x, std::span<const MembraneTriangle> triangles,
                         std::span<Vec3> force);
void add_membrane_stiffness(std::span<const Vec3> x, std::span<const MembraneTriangle> triangles,
                            Stiffness stiffness, const BlockSink& sink);

/// One triangle's, whose particles are in range: adds its forces and returns its energy; its blocks on and
/// below the diagonal.
double add_forces(std::span<const Vec3> x, const MembraneTriangle& triangle,
                  const MembraneConstants& constants, std::span<Vec3> force);
void stiffness_blocks(std::span<const Vec3> x, const MembraneTriangle& triangle, Stiffness stiffness,
                      Mat3* lower);

}  // namespace furrow::physics
