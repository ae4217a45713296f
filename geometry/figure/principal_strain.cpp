// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/principal_strain.h"

#include <array>
#include <cmath>

#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/property_names.h"
#include "geometry/rest/rest_metric.h"

namespace furrow::geometry {
namespace {

/// A triangle of edges 01, 12, 20 laid into the plane: corner 0 at the origin, corner 1 at (x1, 0).
struct Flat {
  double x1, x2, y2;
};

Flat lay_flat(const std::array<double, 3>& l) {
  const double x2 = (l[0] * l[0] + (l[2] - l[1]) * (l[2] + l[1])) / (2 * l[0]);
  return {l[0], x2, 2 * triangle_area(l[0], l[1], l[2]) / l[0]};
}

PrincipalStrain strain_of(const std::array<double, 3>& rest, const std::array<double, 3>& now) {
  if (!is_proper_triangle(rest)) return {unset_value, unset_value};
  if (!(now[0] > 0)) {  // the edge that the frame is made of is a point: turn the corners
    if (!(now[1] > 0)) return {-1, -1};
    return strain_of({rest[1], rest[2], rest[0]}, {now[1], now[2], now[0]});
  }
  // F = [a b; 0 d] takes the rest triangle to the present one.
  const Flat r = lay_flat(rest), n = lay_flat(now);
  const double a = n.x1 / r.x1, d = n.y2 / r.y2, b = (n.x2 - a * r.x2) / r.y2;
  // Singular values of a 2 x 2 matrix: (|F + cof F| ± |F - cof F|) / 2, as lengths of rotation and
  // reflection.
  const double sum = std::hypot(a + d, b), difference = std::hypot(a - d, b);
  return {(sum + difference) / 2 - 1, (sum - difference) / 2 - 1};
}

}  // namespace

std::vector<PrincipalStrain> principal_strains(const Mesh& mesh) {
  require_finite(mesh, "principal_strains");
  require_triangles(mesh, "principal_strains");
  const std::vector<double> rest = rest_lengths(mesh);
  std::vector<double> now(mesh.num_edges(), 0);
  for (Edge e : mesh.edges()) now[e.idx()] = spatial_length(mesh, e);
  std::vector<PrincipalStrain> strains(mesh.num_faces());
  for (Face f : mesh.faces())
    strains[f.idx()] = strain_of(edge_lengths(mesh, f, rest), edge_lengths(mesh, f, now));
  return strains;
}

}  // namespace furrow::geometry
