// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "physics/cloth/element_forces.h"
#include "physics/linear/free_stiffness.h"
#include "physics/packed/packed_cloth.h"
#include "physics/packed/packed_elements.h"

namespace furrow::physics {

/// Energy, forces and stiffness of a cloth's elements for implicit steps: of what is laid out for speed four
/// elements at a time (packed_elements.h), of the rest as elsewhere. The same bits for any number of threads.
class StepElements {
 public:
  /// The cloth must outlive this object and keep its elements; membrane, tension and hinges are sorted by
  /// their least particle (sort_elements()). Throws std::invalid_argument as check_elements().
  explicit StepElements(const Cloth& cloth);
  StepElements(const StepElements&) = delete;
  StepElements& operator=(const StepElements&) = delete;

  /// The energy E [J] at x [m]; force becomes -dE/dx [N]. Cost: one pass. Not for two callers at once.
  double operator()(std::span<const Vec3> x, std::span<Vec3> force, ThreadPool& pool);
  /// What assemble() gives of the stiffness: where a step's search ends does not depend on it.
  static constexpr Stiffness part{1, true};
  /// That part of the stiffness at x. The matrix is made for the cloth, narrow as the part is.
  void assemble(FreeStiffness& matrix, std::span<const Vec3> x, ThreadPool& pool);

 private:
  void place(std::span<const Vec3> x);
  void blocks(const ElementCounts& counts, std::span<const Vec3> x, int begin, int end, Mat3* blocks) const;

  const Cloth& cloth_;
  PackedElements packed_;
  Cloth others_;  ///< springs and energies
  std::optional<ElementForces> other_forces_;
  std::vector<Vec4> x_, force_;  ///< room
};

/// Sorts what is laid out for speed by the least particle: neighbours in memory are so in the cloth.
void sort_elements(Cloth& cloth);

/// A packed cloth with places for vertices: its springs that pull, sorted, its other elements, and particles
/// as they are now.
Cloth cloth_by_place(const PackedCloth& packed);

}  // namespace furrow::physics
