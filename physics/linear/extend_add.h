// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include "physics/linear/front_tree.h"

namespace furrow::physics {

/// Adds a child's update (lower triangle, by columns of `stride`) to some columns of its parent: those whose
/// place is in [begin, end) go to target + place * target_stride, rows by their place.
struct ExtendAdd {
  std::span<const FrontTree::Run> runs;
  const double* update;
  int stride;
  double* target;
  int target_stride, begin, end;
};
void extend_add(const ExtendAdd& e);

}  // namespace furrow::physics
