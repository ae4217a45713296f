// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <utility>
#include <vector>

#include "physics/cloth/elements.h"

namespace furrow::tests {

/// A cloth of one kind of elements, without particles, for the functions of elements.h.
inline physics::Cloth only(std::vector<physics::Spring> springs) {
  physics::Cloth cloth;
  cloth.structural = std::move(springs);
  return cloth;
}
inline physics::Cloth only(std::vector<physics::Tension> tension) {
  physics::Cloth cloth;
  cloth.tension = std::move(tension);
  return cloth;
}

}  // namespace furrow::tests
