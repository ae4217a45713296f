// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/stroke/pierced_faces.h"

#include "geometry/mesh/exact_triangles.h"
#include "geometry/mesh/face_point.h"
#include "geometry/mesh/preconditions.h"

namespace furrow::geometry {

std::vector<char> pierced_faces(const Mesh& mesh, std::span<const Point> points,
                                std::span<const std::array<int, 3>> triangles) {
  require_finite(mesh, "pierced_faces");
  require_triangles(mesh, "pierced_faces");
  const std::vector<Point> own(mesh.points().begin(), mesh.points().end());
  std::vector<std::array<int, 3>> faces(
      mesh.num_faces());  // of a removed one thrice the same corner: no area
  for (Face f : mesh.faces()) {
    const auto c = corners_of(mesh, f);
    faces[f.idx()] = {int(c[0]), int(c[1]), int(c[2])};
  }
  ExactTriangles cloth(own, faces, "pierced_faces"), surface(points, triangles, "pierced_faces");
  std::vector<char> pierced(mesh.num_faces(), 0);
  using Box = ExactTriangles::Box;
  CGAL::box_intersection_d(cloth.boxes.begin(), cloth.boxes.end(), surface.boxes.begin(), surface.boxes.end(),
                           [&](const Box& a, const Box& b) {
                             char& hit = pierced[cloth.names[a.info()]];
                             if (!hit && CGAL::do_intersect(cloth.shapes[a.info()], surface.shapes[b.info()]))
                               hit = 1;
                           });
  return pierced;
}

}  // namespace furrow::geometry
