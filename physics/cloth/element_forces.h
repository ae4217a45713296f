// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

#include "physics/base/thread_pool.h"
#include "physics/cloth/cloth.h"
#include "physics/cloth/membrane.h"

namespace furrow::physics {

/// Energy and forces of a cloth's elements (elements.h) for callers that ask often. The cloth is checked once
/// and the rest constants of its membrane are kept. Both results come from one pass, in two halves of the
/// elements that threads share. Cloth::energies belong to the second half.
class ElementForces {
 public:
  /// The cloth must outlive this object and keep its elements as they are. O(elements). Throws
  /// std::invalid_argument as potential_energy() does.
  explicit ElementForces(const Cloth& cloth);

  /// The energy E [J] at x, one position a particle [m]; force, another array as long as x, becomes -dE/dx
  /// [N]. Cost: one pass. Not for two callers at once. The same bits for any number of threads;
  /// potential_energy() and add_forces() sum in another order.
  double operator()(std::span<const Vec3> x, std::span<Vec3> force, ThreadPool& pool);

 private:
  double add_half(std::span<const Vec3> x, int which, std::span<Vec3> force) const;

  const Cloth& cloth_;
  std::vector<MembraneConstants> membrane_;
  std::vector<Vec3> second_;  ///< forces of the second half
};

}  // namespace furrow::physics
