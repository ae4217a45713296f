// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/fold/wrinkle.h"

namespace furrow::tests {

/// Lines as chains of vertices, with flips that are checked: what the tests of that rule ask for.
inline geometry::WrinkleOptions safe_rule() {
  geometry::WrinkleOptions options;
  options.insertion.rule = geometry::InsertionRule::safe;
  return options;
}

}  // namespace furrow::tests
