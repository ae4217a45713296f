// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cmath>

#include "geometry/mesh/mesh.h"

namespace furrow::tests {

inline double distance(const geometry::Point& a, const geometry::Point& b) {
  return std::sqrt(CGAL::squared_distance(a, b));
}

}  // namespace furrow::tests
