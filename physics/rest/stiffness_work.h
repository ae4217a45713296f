// SPDX-License-Identifier: MIT
#pragma once
#include <memory>

#include "physics/linear/free_stiffness.h"
#include "physics/rest/settle.h"

namespace furrow::physics {

/// The matrix of the solves before, if there is one and it fits; else a new one, which is left in `work`
/// (null: with nobody). narrow: as of FreeStiffness. Cost: FreeStiffness::belongs_to(), or its constructor.
std::shared_ptr<FreeStiffness> stiffness_for(const Cloth& cloth, bool narrow, StiffnessWork* work);

}  // namespace furrow::physics
