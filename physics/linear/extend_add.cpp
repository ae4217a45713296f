// SPDX-License-Identifier: MIT
#include "physics/linear/extend_add.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "physics/base/lanes.h"

namespace furrow::physics {
namespace {

FURROW_INLINE void add(const double* source, double* target, int length) {
  int i = 0;
  for (; i + 4 <= length; i += 4) {
    const Lanes sum = at(target + i) + at(source + i);
    std::memcpy(target + i, &sum, sizeof sum);
  }
  for (; i < length; ++i) target[i] += source[i];
}

FURROW_VECTOR_CLONES void add_all(const ExtendAdd& e) {
  for (std::size_t k = 0; k < e.runs.size(); ++k) {
    const FrontTree::Run& columns = e.runs[k];
    const int end = std::min(columns.length, e.end - columns.to);
    for (int c = std::max(0, e.begin - columns.to); c < end; ++c) {
      const double* source = e.update + std::ptrdiff_t(columns.from + c) * e.stride;
      double* target = e.target + std::ptrdiff_t(columns.to + c) * e.target_stride;
      add(source + columns.from + c, target + columns.to + c, columns.length - c);
      for (std::size_t r = k + 1; r < e.runs.size(); ++r)
        add(source + e.runs[r].from, target + e.runs[r].to, e.runs[r].length);
    }
  }
}

}  // namespace

void extend_add(const ExtendAdd& e) { add_all(e); }

}  // namespace furrow::physics
