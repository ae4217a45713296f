// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <vector>

#include "physics/cloth/cloth.h"

namespace furrow::cases {

using physics::Cloth;

/// How the stiffness k [N/m] of a structural spring follows from its rest length r and the rest areas A of
/// the one or two triangles at its edge. r_avg: mean rest length of the structural springs. No law makes an
/// irregular mesh of springs an exact membrane (Van Gelder 1998); MembraneTriangle does.
enum class MembraneLaw {
  paper,      ///< k = (r / r_avg) k_std; softest, but allows the longest steps (method S1.7)
  uniform,    ///< k = k_std
  inverse,    ///< k = (r_avg / r) k_std; physics of a thread
  van_gelder  ///< k = Y sum(A) / r^2, nearest to a membrane of nu = 1/3 (J. Graphics Tools 3(2), 21-41)
};

/// Of a lattice of equilateral triangles that is a membrane with Young's modulus times thickness Y [N/m]:
/// k = (sqrt(3) / 2) Y, whatever the edge r. Such a lattice is isotropic with nu = 1/3. A strain e stretches
/// the springs along n by e_nn, and each particle owns the area sqrt(3)/2 r^2 and three springs, so
///   W = 1/2 k r^2 sum e_nn^2 / (sqrt(3)/2 r^2) = (sqrt(3)/8) k (2 e:e + (tr e)^2),
/// that is mu = lambda = (sqrt(3)/4) k; then  Y = 4 mu (lambda + mu) / (lambda + 2 mu) = (2 / sqrt(3)) k.
/// Throws std::invalid_argument unless Y >= 0 and finite.
double lattice_stiffness(double young_times_thickness);

/// Rest areas of cloth.triangles [m^2], from the rest lengths of the structural springs (Heron). Cost
/// O(T log S). Throws std::invalid_argument if an edge has no spring, or the lengths make no triangle.
std::vector<double> rest_areas(const Cloth& cloth);

/// k_std [N/m] with which springs of the law answer an affine dilation as a membrane with Y [N/m] and nu =
/// 1/3 does: sum k r^2 = 3 Y A. On a lattice of equilateral triangles that is lattice_stiffness(), but for
/// the rim. van_gelder needs no calibration: the answer is Y. areas: of cloth.triangles [m^2]. Throws
/// std::invalid_argument as set_membrane_stiffness() does, or if there is no spring.
double calibrated_stiffness(const Cloth& cloth, MembraneLaw law, double young_times_thickness,
                            std::span<const double> areas);

/// Sets the stiffness of cloth.structural; rest lengths and all else stay. stiffness: k_std [N/m], for
/// van_gelder Y [N/m]; >= 0. areas: of cloth.triangles [m^2], each > 0; only van_gelder looks at their
/// values. A spring that is no triangle's edge gets 0 from van_gelder. Cost O(T log S). Throws
/// std::invalid_argument, nothing changed, if stiffness, an area or a rest length is out of its range, there
/// are not as many areas as triangles, or the springs are not sorted by (a, b).
void set_membrane_stiffness(Cloth& cloth, MembraneLaw law, double stiffness, std::span<const double> areas);

}  // namespace furrow::cases
