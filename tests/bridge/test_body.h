// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "bridge/arrays/gather.h"
#include "geometry/figure/repair_body.h"
#include "physics/body/exact_distance.h"

namespace furrow::tests {

/// A body as the measures of fit ask for it: its triangles, and the exact distance from them.
struct Body {
  physics::TriangleMesh triangles;
  physics::ExactDistance distance;
  explicit Body(const geometry::Mesh& mesh)
      : triangles(bridge::to_triangle_mesh(geometry::repair_body(mesh))), distance(triangles) {}
};

}  // namespace furrow::tests
