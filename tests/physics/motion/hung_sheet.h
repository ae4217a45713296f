// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "physics/cloth/pins.h"
#include "tests/physics/cloth/test_cloths.h"

namespace furrow::tests {

/// A crumpled sheet that hangs from two corners.
inline Cloth hung_sheet(int columns = 12, int rows = 10) {
  Cloth cloth = sheet(columns, rows, 0.05, 0.2, 2);
  pin(cloth.particles, std::vector<int>{0, columns - 1});
  return cloth;
}

}  // namespace furrow::tests
