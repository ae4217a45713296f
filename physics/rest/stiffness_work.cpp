// SPDX-License-Identifier: MIT
#include "physics/rest/stiffness_work.h"

namespace furrow::physics {

std::shared_ptr<FreeStiffness> stiffness_for(const Cloth& cloth, bool narrow, StiffnessWork* work) {
  if (work && work->stiffness && work->stiffness->narrow() == narrow && work->stiffness->belongs_to(cloth))
    return work->stiffness;
  auto made = std::make_shared<FreeStiffness>(cloth, narrow);
  if (work) work->stiffness = made;
  return made;
}

}  // namespace furrow::physics
