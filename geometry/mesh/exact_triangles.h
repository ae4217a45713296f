// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/mesh.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {

/// Triangles with an area, as exact predicates take them, and their boxes.
struct ExactTriangles {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;  ///< with the shape's index

  std::vector<Kernel::Triangle_3> shapes;
  std::vector<std::size_t> names;  ///< as the triangles were numbered
  std::vector<Box> boxes;

  /// Those given, by their indices. Throws ContentError, which begins with `operation`, for a position that
  /// is not finite and a corner that is no index of `points`.
  ExactTriangles(std::span<const Point> points, std::span<const std::array<int, 3>> triangles,
                 const char* operation) {
    for (const Point& p : points)
      if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z()))
        throw ContentError(std::string(operation) + ": a position is not finite; repair the mesh first");
    for (std::size_t name = 0; name < triangles.size(); ++name) {
      physics::throw_if_cancelled(operation);
      std::array<Kernel::Point_3, 3> p;
      for (std::size_t i = 0; i < 3; ++i) {
        const int v = triangles[name][i];
        if (v < 0 || static_cast<std::size_t>(v) >= points.size())
          throw ContentError(std::string(operation) + ": a triangle names the vertex " + std::to_string(v));
        const Point& q = points[static_cast<std::size_t>(v)];
        p[i] = {q.x(), q.y(), q.z()};
      }
      if (CGAL::collinear(p[0], p[1], p[2])) continue;
      shapes.emplace_back(p[0], p[1], p[2]);
      names.push_back(name);
      boxes.emplace_back(shapes.back().bbox(), shapes.size() - 1);
    }
  }
};

}  // namespace furrow::geometry
