// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace furrow::tests {

/// A mesh's points and triangles as plain arrays, as a body comes to the geometry layer.
struct TriangleSoup {
  std::vector<geometry::Point> points;
  std::vector<std::array<int, 3>> triangles;
  explicit TriangleSoup(const geometry::Mesh& mesh) : points(mesh.points().begin(), mesh.points().end()) {
    for (const geometry::Face f : mesh.faces()) {
      const geometry::Halfedge h = mesh.halfedge(f);
      triangles.push_back({int(mesh.source(h)), int(mesh.target(h)), int(mesh.target(mesh.next(h)))});
    }
  }
};

}  // namespace furrow::tests
