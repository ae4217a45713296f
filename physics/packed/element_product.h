// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include "physics/cloth/cloth.h"

namespace furrow::physics {

/// The stiffness matrix of membrane triangles, tension and hinges at a cloth's positions as a sparse matrix
/// of blocks, for limits of steps: the membrane's positive part, tension after add_tension_stiffness_bound(),
/// hinges after add_hinge_stiffness_bound(). Memory: about 80 bytes times 13 blocks a particle; cost of
/// building: one pass and a sort of (9 triangles + 4 tensions + 16 hinges) keys.
class ElementProduct {
 public:
  /// Throws std::invalid_argument as check_elements() does.
  explicit ElementProduct(const Cloth& cloth);
  /// product += K u; one entry a particle.
  void add(std::span<const Vec3> u, std::span<Vec3> product) const;
  /// row[i] += s_i sum_j |K_ij| s_j: with s = m^-1/2 a bound of eigenvalues (Gershgorin), by Frobenius'
  /// norms.
  void add_row_sums(std::span<const double> scale, std::span<double> row) const;

 private:
  std::vector<std::size_t> row_begin_;  // empty without elements
  std::vector<int> column_;
  std::vector<Mat3> block_;
};

}  // namespace furrow::physics
