// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/rest/rest_angles.h"

#include <cmath>

#include "geometry/mesh/property_names.h"

namespace furrow::geometry {

double dihedral_angle(const Mesh& mesh, Edge edge) {
  if (mesh.is_border(edge)) return 0;
  const Halfedge h = mesh.halfedge(edge), o = mesh.opposite(h);
  const Point &a = mesh.point(mesh.source(h)), &b = mesh.point(mesh.target(h));
  const Vector e = b - a, n = CGAL::cross_product(e, mesh.point(mesh.target(mesh.next(h))) - a),
               m = CGAL::cross_product(mesh.point(mesh.target(mesh.next(o))) - a, e);
  // theta = atan2((n x m) . e / |e|, n . m)
  const double length = std::sqrt(e.squared_length()), sine = CGAL::cross_product(n, m) * e, cosine = n * m;
  return length > 0 && (sine != 0 || cosine != 0) ? std::atan2(sine / length, cosine) : 0;
}

void ensure_rest_angles(Mesh& mesh) {
  auto angle = ensure_map(mesh, attribute::rest_angle);
  for (Edge e : mesh.edges())
    if (!mesh.is_border(e) && std::isnan(angle[e])) angle[e] = dihedral_angle(mesh, e);
}

}  // namespace furrow::geometry
