// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/stroke/pierced_faces.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/preconditions.h"

namespace furrow::geometry {
namespace {

using Exact = CGAL::Exact_predicates_inexact_constructions_kernel;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;

/// Triangles with an area, and their boxes.
struct Soup {
  std::vector<Exact::Triangle_3> shapes;
  std::vector<Box> boxes;
  std::vector<std::size_t> ids;  ///< of each shape

  void add(const std::array<Point, 3>& corners, std::size_t id) {
    std::array<Exact::Point_3, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = {corners[i].x(), corners[i].y(), corners[i].z()};
    if (CGAL::collinear(p[0], p[1], p[2])) return;
    shapes.emplace_back(p[0], p[1], p[2]);
    boxes.emplace_back(shapes.back().bbox(), shapes.size() - 1);
    ids.push_back(id);
  }
};

Soup soup_of(const Mesh& mesh) {
  Soup soup;
  for (Face f : mesh.faces()) {
    std::array<Point, 3> corners;
    std::size_t i = 0;
    for (Vertex v : mesh.vertices_around_face(mesh.halfedge(f))) corners[i++] = mesh.point(v);
    soup.add(corners, f.idx());
  }
  return soup;
}

Soup soup_of(std::span<const Point> points, std::span<const std::array<int, 3>> triangles) {
  const auto is_finite = [](const Point& p) {
    return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z());
  };
  if (!std::all_of(points.begin(), points.end(), is_finite))
    throw ContentError("pierced_faces: a position of the surface is not finite; repair it first");
  Soup soup;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    std::array<Point, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const int v = triangles[t][i];
      if (v < 0 || static_cast<std::size_t>(v) >= points.size())
        throw ContentError("pierced_faces: a triangle names the vertex " + std::to_string(v));
      corners[i] = points[static_cast<std::size_t>(v)];
    }
    soup.add(corners, t);
  }
  return soup;
}

}  // namespace

std::vector<char> pierced_faces(const Mesh& mesh, std::span<const Point> points,
                                std::span<const std::array<int, 3>> triangles) {
  require_finite(mesh, "pierced_faces");
  require_triangles(mesh, "pierced_faces");
  Soup cloth = soup_of(mesh), surface = soup_of(points, triangles);
  std::vector<char> pierced(mesh.num_faces(), 0);
  CGAL::box_intersection_d(cloth.boxes.begin(), cloth.boxes.end(), surface.boxes.begin(), surface.boxes.end(),
                           [&](const Box& a, const Box& b) {
                             char& hit = pierced[cloth.ids[a.info()]];
                             if (!hit && CGAL::do_intersect(cloth.shapes[a.info()], surface.shapes[b.info()]))
                               hit = 1;
                           });
  return pierced;
}

}  // namespace furrow::geometry
