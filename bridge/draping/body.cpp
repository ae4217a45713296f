// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/arrays/convert.h"
#include "bridge/arrays/gather.h"
#include "geometry/figure/repair_body.h"

namespace furrow::bridge {

physics::TriangleMesh to_triangle_mesh(const geometry::Body& body) {
  physics::TriangleMesh mesh;
  mesh.vertices.reserve(body.points.size());
  for (const geometry::Point& p : body.points) mesh.vertices.push_back(to_eigen(p));
  mesh.triangles = body.triangles;
  return mesh;
}

}  // namespace furrow::bridge
