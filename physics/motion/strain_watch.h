// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "physics/motion/simulate.h"
#include "physics/packed/packed_cloth.h"

namespace furrow::physics {

/// Looks for the longest edge of a cloth in motion: what stretches for a moment is not seen at the end.
class StrainWatch {
 public:
  /// packed: of the cloth, with the same particles.
  StrainWatch(const Cloth& cloth, const PackedCloth& packed);
  /// The longest edge at this time [s], if that is longer than `known`; else this. Cost: one pass.
  LongestEdge look(const PackedCloth& packed, double time, const LongestEdge& known) const;

 private:
  std::vector<Spring> edges_;  ///< by place
};

}  // namespace furrow::physics
