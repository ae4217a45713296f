// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/fold_base.h"

#include <cmath>
#include <numbers>

#include "geometry/mesh/tangent_frames.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

constexpr double share = 0.5;
constexpr int rounds = 6;

double angle_between(const Vector& a, const Vector& b) {
  return std::atan2(std::sqrt(CGAL::cross_product(a, b).squared_length()), a * b);
}

}  // namespace

Point curved_place(const Mesh& mesh, const std::vector<Vector>& normals, const FacePoint& at) {
  const auto corners = corners_of(mesh, at.face);
  const Point flat = position_of(mesh, at);
  Vector off(0, 0, 0);  // mean of the way to the corners' tangent planes
  for (int i = 0; i < 3; ++i) {
    const Vector& n = normals[corners[i].idx()];
    off = off - at.barycentrics[i] * ((flat - mesh.point(corners[i])) * n) * n;
  }
  return flat + share * off;
}

void average_normals(const Mesh& mesh, const std::vector<bool>& of, std::vector<Vector>& normals) {
  std::vector<Vector> next = normals;
  for (int round = 0; round < rounds; ++round) {
    for (Vertex v : mesh.vertices()) {
      physics::throw_if_cancelled("wrinkle");
      if (!of[v.idx()] || mesh.is_isolated(v)) continue;
      Vector sum = normals[v.idx()];
      for (Halfedge h : mesh.halfedges_around_target(mesh.halfedge(v)))
        sum = sum + normals[mesh.source(h).idx()];
      const double length = std::sqrt(sum.squared_length());
      next[v.idx()] = length > 0 ? sum / length : normals[v.idx()];
    }
    normals.swap(next);
  }
}

std::vector<Vector> averaged_normals(const Mesh& mesh) {
  std::vector<Vector> normals = vertex_normals(mesh);
  average_normals(mesh, std::vector<bool>(mesh.num_vertices(), true), normals);
  return normals;
}

std::vector<double> angle_defects(const Mesh& mesh) {
  std::vector<double> angles(mesh.num_vertices(), 0);
  for (Face f : mesh.faces()) {
    const auto c = corners_of(mesh, f);
    for (int i = 0; i < 3; ++i) {
      const Point &p = mesh.point(c[i]), &q = mesh.point(c[(i + 1) % 3]), &r = mesh.point(c[(i + 2) % 3]);
      angles[c[i].idx()] += angle_between(q - p, r - p);
    }
  }
  std::vector<double> defects(mesh.num_vertices(), 0);
  for (Vertex v : mesh.vertices())
    if (!mesh.is_isolated(v) && !mesh.is_border(v)) defects[v.idx()] = 2 * std::numbers::pi - angles[v.idx()];
  return defects;
}

double angle_defect(const Mesh& mesh) {
  double area = 0, sum = 0;
  for (Face f : mesh.faces()) area += std::sqrt(area_normal_of(mesh, f).squared_length()) / 2;
  for (double defect : angle_defects(mesh)) sum += std::abs(defect);
  return area > 0 ? sum / area : 0;
}

}  // namespace furrow::geometry
