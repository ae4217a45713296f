// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <cmath>

#include "geometry/figure/limb_places.h"
#include "geometry/figure/repair_body.h"
#include "geometry/figure/skeleton.h"
#include "tests/test_meshes.h"
#include "tests/test_paths.h"

namespace furrow::tests {

inline geometry::Mesh our_mannequin() { return read_plain_obj(source_dir() / "meshes/mannequin.obj"); }

inline geometry::Skeleton skeleton_of(const geometry::Mesh& mesh) {
  const geometry::Body body = geometry::repair_body(mesh);
  return geometry::find_skeleton(body.points, body.triangles);
}

inline geometry::Mesh scaled(geometry::Mesh mesh, double by) {
  for (const geometry::Vertex v : mesh.vertices())
    mesh.point(v) = CGAL::ORIGIN + by * (mesh.point(v) - CGAL::ORIGIN);
  return mesh;
}

/// A place near an arm after the arm is raised sideways about its root, as much of the turn as it lies beyond
/// it.
inline geometry::Point raised(const geometry::Arm& arm, double angle, const geometry::Point& p) {
  const geometry::Point root = arm.rings.front().centre;
  const double along = (p - root) * arm.axis, t = std::clamp(along / 0.06, 0.0, 1.0);
  const double turn = (root.x() > 0 ? 1 : -1) * angle * t * t * (3 - 2 * t);
  const double x = p.x() - root.x(), y = p.y() - root.y(), c = std::cos(turn), s = std::sin(turn);
  return {root.x() + c * x - s * y, root.y() + s * x + c * y, p.z()};
}

/// A figure with its arms raised sideways by an angle [rad]: what lies outside of their roots turns.
inline geometry::Mesh with_raised_arms(geometry::Mesh mesh, double angle) {
  const geometry::Skeleton s = skeleton_of(mesh);
  for (const geometry::Vertex v : mesh.vertices())
    for (int side = 0; side < 2; ++side)
      if (geometry::nearest_part(s, mesh.point(v)) == geometry::arm_part(side))
        mesh.point(v) = raised(*s.arms[std::size_t(side)], angle, mesh.point(v));
  return mesh;
}

}  // namespace furrow::tests
