// SPDX-License-Identifier: GPL-3.0-or-later
// Two garments as strangers send them: uneven faces of several corners, no symmetry.
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "meshes/garments.h"
#include "meshes/mannequin.h"
#include "meshes/surfaces.h"

namespace furrow::meshes {
namespace {

using geometry::Face;
using geometry::Mesh;
using geometry::Point;

const Loft dress_skirt({0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1},
                       {{0.48, 0.246, 0.222, -0.010},
                        {0.62, 0.230, 0.206, -0.010},
                        {0.72, 0.219, 0.195, -0.011},
                        {0.84, 0.203, 0.178, -0.012},
                        {0.92, 0.188, 0.160, -0.010},
                        {1.00, 0.160, 0.130, 0.000},
                        {1.06, 0.138, 0.110, 0.005},
                        {1.16, 0.138, 0.110, 0.003}});
const Loft tunic_sack({0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1},
                      {{0.66, 0.222, 0.192, -0.010},
                       {0.84, 0.214, 0.182, -0.010},
                       {1.00, 0.200, 0.168, -0.004},
                       {1.12, 0.188, 0.156, 0.002},
                       {1.25, 0.176, 0.144, 0.002},
                       {1.31, 0.170, 0.122, -0.008},
                       {1.36, 0.156, 0.092, -0.022},
                       {1.40, 0.124, 0.066, -0.030}});

/// > 0 outside the hole for the arm on that side (1: the figure's left).
double from_armhole(const Vec& p, double side, double radius) {
  return (p - Vec(side * 0.180, 1.325, -0.024)).norm() - radius;
}

/// A strap over the left shoulder; the edge falls from there to below the right arm.
double from_dress_holes(const Vec& p) {
  const double hem = p.y() - 0.52 - 0.15 * (p.x() + 0.2) * (p.x() + 0.2);
  const double slant = 1.245 + 0.80 * (p.x() + 0.17) - p.y();
  const double x = p.x() / 0.088, z = (p.z() + 0.010) / 0.084;
  const double neck = p.y() > 1.3 ? (std::sqrt(x * x + z * z) - 1) * 0.085 : 1;
  return std::min({hem, slant, neck, from_armhole(p, 1, 0.072)});
}

/// A neck cut down to the breast bone, no sleeves, and a slit at each side from the hem to the hip.
double from_tunic_holes(const Vec& p) {
  const double hem = p.y() - 0.70 - (p.z() < 0 ? 0 : 0.10 * p.z());
  const double slit =
      std::max({std::abs(p.z() + 0.01) - 0.008 - 0.10 * (0.93 - p.y()), p.y() - 0.93, 0.1 - std::abs(p.x())});
  const double x = p.x() / 0.092, z = (p.z() + 0.010) / 0.086;
  const double round = p.y() > 1.3 ? (std::sqrt(x * x + z * z) - 1) * 0.085 : 1;
  const double pointed = std::max(std::abs(p.x()) - 0.42 * (p.y() - 1.21), -p.z());
  const double arms = std::min(from_armhole(p, 1, 0.080), from_armhole(p, -1, 0.080));
  return std::min({hem, slit, round, pointed, arms});
}

Vec at(const Mesh& mesh, geometry::Vertex v) {
  const Point& p = mesh.point(v);
  return {p.x(), p.y(), p.z()};
}

Vec centre(const Mesh& mesh, Face f) {
  Vec sum(0, 0, 0);
  for (auto v : mesh.vertices_around_face(mesh.halfedge(f))) sum += at(mesh, v);
  return sum / mesh.degree(f);
}

/// Triangles of another edge [m] where `there` > 0.
void remesh_part(Mesh& mesh, double edge, const Solid& there) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  std::vector<Face> part;
  for (Face f : mesh.faces())
    if (there(centre(mesh, f)) > 0) part.push_back(f);
  pmp::isotropic_remeshing(part, edge, mesh,
                           pmp::parameters::number_of_iterations(3).number_of_relaxation_steps(2));
  mesh.collect_garbage();
}

/// Pulls every vertex but those of borders a fifth of the way to one of its neighbours.
void make_uneven(Mesh& mesh) {
  unsigned number = 1;
  for (auto v : mesh.vertices()) {
    number = number * 1664525u + 1013904223u;  // Numerical Recipes' generator
    if (mesh.is_border(v)) continue;
    auto h = mesh.halfedge(v);
    for (unsigned turns = (number >> 24) % 6; turns > 0; --turns) h = mesh.opposite(mesh.next(h));
    const Point p = mesh.point(v), q = mesh.point(mesh.source(h));
    mesh.point(v) = p + 0.2 * (q - p);
  }
}

/// The corners of the face that is left when the edge of h goes.
std::vector<Vec> joined_corners(const Mesh& mesh, geometry::Halfedge h) {
  std::vector<Vec> corners;
  for (const auto side : {h, mesh.opposite(h)})
    for (auto k = mesh.next(side); k != side; k = mesh.next(k)) corners.push_back(at(mesh, mesh.source(k)));
  return corners;
}

/// Whether these corners lie nearly in a plane, within 12 degrees, and the way around them turns to one side.
bool make_a_face(const std::vector<Vec>& corners) {
  const std::size_t n = corners.size();
  Vec middle(0, 0, 0), normal(0, 0, 0);
  for (const Vec& p : corners) middle += p / double(n);
  for (std::size_t i = 0; i < n; ++i) normal += (corners[i] - middle).cross(corners[(i + 1) % n] - middle);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec in = corners[(i + 1) % n] - corners[i], out = corners[(i + 2) % n] - corners[(i + 1) % n];
    const Vec turn = in.cross(out);
    if (turn.dot(normal) < 0.978 * turn.norm() * normal.norm()) return false;
    if (turn.norm() < 0.15 * in.norm() * out.norm()) return false;
  }
  return true;
}

/// Joins neighbours into faces of at most so many corners as `most` says of the place.
void join_faces(Mesh& mesh, const std::function<int(const Vec&)>& most) {
  for (auto e : mesh.edges()) {
    if (mesh.is_border(e)) continue;
    const auto h = mesh.halfedge(e);
    const Face f = mesh.face(h), g = mesh.face(mesh.opposite(h));
    if (int(mesh.degree(f) + mesh.degree(g)) - 2 > most(centre(mesh, f))) continue;
    if (mesh.degree(mesh.source(h)) < 4 || mesh.degree(mesh.target(h)) < 4) continue;
    if (make_a_face(joined_corners(mesh, h))) CGAL::Euler::join_face(h, mesh);
  }
  mesh.collect_garbage();
}

}  // namespace

Mesh make_dress() {
  const auto body = [](const Vec& p) { return smooth_union(trunk(p) - 0.010, dress_skirt(p), 0.03); };
  Mesh mesh = cut(mesh_surface(body, {-0.36, 0.40, -0.32}, {0.36, 1.60, 0.32}, 0.012), from_dress_holes);
  remesh(mesh, 0.024);
  remesh_part(mesh, 0.036, [](const Vec& p) { return 0.86 - p.y() + 0.3 * p.x(); });
  make_uneven(mesh);
  join_faces(mesh, [](const Vec& p) { return p.y() + 0.4 * p.x() < 1.0 ? 4 : 3; });
  return mesh;
}

Mesh make_tunic() {
  const auto body = [](const Vec& p) { return smooth_union(trunk(p) - 0.011, tunic_sack(p), 0.03); };
  Mesh mesh = cut(mesh_surface(body, {-0.32, 0.58, -0.28}, {0.32, 1.60, 0.28}, 0.012), from_tunic_holes);
  remesh(mesh, 0.024);
  make_uneven(mesh);
  join_faces(mesh, [](const Vec& p) { return p.z() > 0 ? 6 : p.y() < 1.1 ? 5 : 3; });
  return mesh;
}

}  // namespace furrow::meshes
