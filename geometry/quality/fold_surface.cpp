// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/quality/fold_surface.h"

#include <cmath>

#include "geometry/fold/fold_base.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/tangent_frames.h"
#include "geometry/stroke/project_onto_surface.h"

namespace furrow::geometry {
namespace {

constexpr int foot_rounds = 4;
constexpr double foot_tolerance = 1e-7;  ///< of a foot beside the normal through it [m]
constexpr double other_layer = -0.2;     ///< cosine of the normals of a vertex and of the face below it

Eigen::Vector3d eigen(const Point& p) { return {p.x(), p.y(), p.z()}; }

std::vector<Vector> area_normals(const Mesh& mesh, std::span<const Point> places) {
  std::vector<Vector> normals(mesh.num_vertices(), Vector(0, 0, 0));
  for (Face f : mesh.faces()) {
    const auto c = corners_of(mesh, f);
    const Point& p = places[c[0].idx()];
    const Vector n = CGAL::cross_product(places[c[1].idx()] - p, places[c[2].idx()] - p);
    for (Vertex v : c) normals[v.idx()] = normals[v.idx()] + n;
  }
  for (Vector& n : normals) n = normalized(n);
  return normals;
}

FoldSurface empty_surface(const Mesh& mesh) {
  FoldSurface surface;
  surface.mesh = &mesh;
  surface.feet.assign(mesh.num_vertices(), Eigen::Vector3d::Constant(unset_value));
  surface.heights.assign(mesh.num_vertices(), unset_value);
  return surface;
}

void set_foot(FoldSurface& surface, Vertex v, double height, const Vector& normal) {
  surface.heights[v.idx()] = height;
  surface.feet[v.idx()] = eigen(surface.mesh->point(v) - height * normal);
}

/// The garment before its folds, with what is asked of it.
struct Base {
  const Mesh& mesh;
  bool flat;
  std::vector<Vector> normals = vertex_normals(mesh);
  SurfaceProjector projector{mesh};

  Vector normal_at(const FacePoint& at) const {
    const auto corners = corners_of(mesh, at.face);
    if (flat) return normalized(area_normal_of(mesh, at.face));
    Vector sum(0, 0, 0);
    for (int i = 0; i < 3; ++i) sum = sum + at.barycentrics[i] * normals[corners[i].idx()];
    return normalized(sum);
  }
  Point place_at(const FacePoint& at) const {
    return flat ? position_of(mesh, at) : curved_place(mesh, normals, at);
  }
};

/// The foot is where the normal goes through the vertex: found from the nearest point on.
void find_foot(const Base& base, Vertex v, const Vector& facing, FoldSurface& surface) {
  const Point& p = surface.mesh->point(v);
  Point query = p;
  for (int round = 0;; ++round) {
    const SurfaceHit hit = base.projector.closest(query);
    const Vector normal = base.normal_at(hit.point), way = p - base.place_at(hit.point);
    if (normal * facing < other_layer) return;
    const double height = way * normal;
    const Vector beside = way - height * normal;
    if (round == foot_rounds || beside.squared_length() < foot_tolerance * foot_tolerance || hit.on_border)
      return set_foot(surface, v, height, normal);
    query = p - height * normal;
  }
}

}  // namespace

bool FoldSurface::has_foot(Vertex v) const { return !std::isnan(heights[v.idx()]); }

FoldSurface surface_over(const Mesh& mesh, std::span<const Point> before) {
  if (before.size() != mesh.num_vertices())
    refuse("surface_over", std::to_string(before.size()) + " places for " +
                               std::to_string(mesh.num_vertices()) + " vertices");
  FoldSurface surface = empty_surface(mesh);
  const std::vector<Vector> normals = area_normals(mesh, before);
  for (Vertex v : mesh.vertices())
    if (!mesh.is_isolated(v))
      set_foot(surface, v, (mesh.point(v) - before[v.idx()]) * normals[v.idx()], normals[v.idx()]);
  return surface;
}

FoldSurface surface_over(const Mesh& mesh, const Mesh& base, bool flat) {
  if (base.number_of_faces() == 0) throw ContentError("the garment before its folds has no faces");
  FoldSurface surface = empty_surface(mesh);
  const Base below{base, flat};
  const std::vector<Vector> facing = vertex_normals(mesh);
  for (Vertex v : mesh.vertices())
    if (!mesh.is_isolated(v)) find_foot(below, v, facing[v.idx()], surface);
  return surface;
}

}  // namespace furrow::geometry
