// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <array>
#include <span>
#include <tuple>

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

/// Woven cloth, as strips of it are measured [N/m]: warp and weft at right angles at rest.
struct WovenModuli {
  double warp, weft;   ///< Y1, Y2: Young's moduli times thickness of strips along warp and weft; > 0
  double shear;        ///< G; > 0
  double poisson = 0;  ///< nu12: a strip along the warp, stretched by e, narrows by nu12 e; nu12^2 < Y1 / Y2
};
/// What makes a triangle of it: C11 = lambda + 2 mu + warp, C22 = lambda + 2 mu + weft, C12 = lambda, C33 =
/// mu.
struct WovenSheet {
  PlaneLame lame;
  double warp, weft;  ///< of Threads [N/m]
};
/// Throws std::invalid_argument if the stiffness is not positive definite.
WovenSheet woven_sheet(const WovenModuli& moduli);
/// Young's modulus times thickness of a strip cut at `angle` [rad] to the warp [N/m]:
/// 1 / Y = c^4 / Y1 + s^4 / Y2 + (1 / G - 2 nu12 / Y1) c^2 s^2.
double strip_modulus(const WovenModuli& moduli, double angle);

/// What a triangle's rest state comes to. With d_i = l_i^2 - L_i^2 of the edge opposite corner i, rest angles
/// a_i and rest area A the strain of Green has
///   tr E = sum d_i cot a_i / (4 A),   det E = (2 (d0 d1 + d1 d2 + d2 d0) - sum d_i^2) / (64 A^2),
/// so the energy  W = A ((lambda/2 + mu) (tr E)^2 - 2 mu det E) = 1/2 d^T H d  has a constant H. Threads
/// along a unit vector n add A warp p p^T to it, p_i = -(t_j . n) (t_k . n) / (8 A^2) with the edges t turned
/// by 90 degrees, for  n^T E n = sum d_i p_i.
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

/// What elements.h asks of a kind.
inline std::array<int, 3> vertices(const MembraneTriangle& t) { return t.vertices; }
inline void renumber(MembraneTriangle& t, std::span<const int> place) {
  for (int& v : t.vertices) v = place[v];
}
inline auto fields(const MembraneTriangle& t) {
  const auto& [a, b, c] = t.vertices;
  const auto& [l0, l1, l2] = t.rest_lengths;
  return std::tuple(a, l0, b, l1, c, l2, t.lambda, t.mu);
}
/// Throws std::invalid_argument if it names a particle out of range or one twice, or as membrane_constants().
void check(const MembraneTriangle& triangle, std::size_t particles);
double energy(std::span<const Vec3> x, const MembraneTriangle& triangle);
/// The tension of an edge is 2 dW/dd times its vector.
double add_forces(std::span<const Vec3> x, const MembraneTriangle& triangle, std::span<Vec3> force);
/// Stiffness::positive_part clamps the eigenvalues of the part that the tensions make (K >= exact); the other
/// part is semidefinite.
void stiffness_blocks(std::span<const Vec3> x, const MembraneTriangle& triangle, Stiffness stiffness,
                      Mat3* lower);
/// The same forces, for callers that keep what the rest state comes to.
double add_forces(std::span<const Vec3> x, const MembraneTriangle& triangle,
                  const MembraneConstants& constants, std::span<Vec3> force);

/// As edges that stretch: ends and rest length, and the stiffness that they are damped by [N/m].
inline std::array<Spring, 3> edges(const MembraneTriangle& t) {
  const auto& [a, b, c] = t.vertices;
  return {Spring{b, c, t.rest_lengths[0], 0}, {c, a, t.rest_lengths[1], 0}, {a, b, t.rest_lengths[2], 0}};
}
std::array<double, 3> edge_stiffness(const MembraneTriangle& triangle);

}  // namespace furrow::physics
