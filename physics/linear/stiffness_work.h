// SPDX-License-Identifier: MIT
#pragma once
#include <memory>

#include "physics/linear/free_stiffness.h"

namespace furrow::physics {

/// What one solve may leave to the next on a cloth with the same elements and held particles: where blocks of
/// the matrix lie and the order of elimination. It changes no bit. For one solve at a time.
struct StiffnessWork {
  std::shared_ptr<FreeStiffness> stiffness;  ///< filled by the first; anew where it does not fit
};

/// That of the solves before, if there is one and it fits; else a new one, which is left in `work` (null:
/// with nobody). Cost: FreeStiffness::belongs_to(), or its constructor.
std::shared_ptr<FreeStiffness> stiffness_for(const Cloth& cloth, bool narrow, StiffnessWork* work);

}  // namespace furrow::physics
