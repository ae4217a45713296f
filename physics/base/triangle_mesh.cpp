// SPDX-License-Identifier: MIT
#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>
#include <string>

#include "physics/base/arrays.h"
#include "physics/base/require.h"

namespace furrow::physics {

namespace {

void require_corners(std::span<const std::array<int, 3>> triangles, std::size_t vertices, const char* who) {
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const int v : triangles[t])
      if (v < 0 || std::size_t(v) >= vertices)
        refuse(who, "triangle ", t, " names vertex ", v, " of ", vertices);
}

}  // namespace

void check_body(const TriangleMesh& mesh, const char* who) {
  const std::string start = std::string(who) + ": ";
  if (mesh.triangles.empty()) throw std::invalid_argument(start + "the body has no triangle");
  require_corners(mesh.triangles, mesh.vertices.size(), who);
  bool has_area = false;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int v : mesh.triangles[t]) {
      if (!(mesh.vertices[v].cwiseAbs().sum() <= 1e9))  // also false for NaN
        throw std::invalid_argument(start + "vertex " + std::to_string(v) + " is not finite or beyond 1e9 m");
    }
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3 ab = mesh.vertices[b] - mesh.vertices[a], ac = mesh.vertices[c] - mesh.vertices[a];
    has_area = has_area || ab.cross(ac).squaredNorm() > 0;
  }
  if (!has_area) throw std::invalid_argument(start + "no triangle of the body has an area");
}

double bounding_diagonal(const TriangleMesh& mesh) {
  require_corners(mesh.triangles, mesh.vertices.size(), "bounding_diagonal");
  Eigen::AlignedBox3d box;
  for (const auto& t : mesh.triangles)
    for (int v : t) box.extend(mesh.vertices[v]);
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

std::vector<Vec3> vertex_normals(std::span<const std::array<int, 3>> triangles, std::span<const Vec3> x) {
  require_corners(triangles, x.size(), "vertex_normals");
  std::vector<Vec3> normal(x.size(), Vec3::Zero());
  for (const auto& t : triangles) {
    const Vec3 &a = x[std::size_t(t[0])], &b = x[std::size_t(t[1])], &c = x[std::size_t(t[2])];
    const Vec3 n = (b - a).eval().cross((c - a).eval());
    for (const int v : t) normal[std::size_t(v)] += n;
  }
  return normal;
}

}  // namespace furrow::physics
