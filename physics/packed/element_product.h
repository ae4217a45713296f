// SPDX-License-Identifier: MIT
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "physics/cloth/cloth.h"

namespace furrow::physics {

/// The stiffness matrix of all elements but springs at a cloth's positions as a sparse matrix of blocks, for
/// limits of steps: of each kind what its stiffness_bound_blocks() say, or the positive part; so of
/// Cloth::energies. An energy without stiffness counts by central differences of its forces, over a millionth
/// of the cloth's size. Memory: about 80 bytes times 13 blocks a particle; cost of building: one pass and a
/// sort of (9 triangles + 4 tensions + 16 hinges) keys.
class ElementProduct {
 public:
  /// Throws std::invalid_argument as check_elements() does.
  explicit ElementProduct(const Cloth& cloth);
  /// product += K u; one entry a particle.
  /// Of an energy without stiffness two passes of its forces.
  void add(std::span<const Vec3> u, std::span<Vec3> product) const;
  /// row[i] += s_i sum_j |K_ij| s_j: with s = m^-1/2 a bound of eigenvalues (Gershgorin), by Frobenius'
  /// norms.
  /// Energies without stiffness add nothing here.
  void add_row_sums(std::span<const double> scale, std::span<double> row) const;
  /// Whether these sums bound the eigenvalues: no energy is without stiffness.
  bool is_bounded() const { return rough_.empty(); }

 private:
  void add_differences(std::span<const Vec3> u, std::span<Vec3> product) const;

  std::vector<std::size_t> row_begin_;  // empty without elements
  std::vector<int> column_;
  std::vector<Mat3> block_;
  std::vector<std::shared_ptr<const Energy>> rough_;  // without stiffness
  std::vector<Vec3> x_;                               // where there are any
  double reach_ = 0;                                  // of a difference [m]
};

}  // namespace furrow::physics
