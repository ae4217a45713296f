// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/thicken.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace furrow::io {
namespace {

using Eigen::Vector3d;

constexpr int rim_quads = 4;

Vector3d flat_normal(const PreparedMesh& mesh, int triangle) {
  const auto& t = mesh.triangles[triangle];
  const Vector3d& a = mesh.vertices[t[0]];
  return (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).normalized();
}

std::vector<MeshSide> border_sides(const PreparedMesh& mesh) {
  const std::vector<MeshSide> sides = sorted_sides(mesh);
  std::vector<MeshSide> border;
  for (std::size_t i = 0, end; i < sides.size(); i = end) {
    end = i + 1;
    while (end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high) ++end;
    if (end == i + 1) border.push_back(sides[i]);
  }
  return border;
}

/// Away from the cloth, along it, at each vertex of a border: unit, across the normal; else 0.
std::vector<Vector3d> outward_directions(const PreparedMesh& mesh, const std::vector<MeshSide>& border) {
  std::vector<Vector3d> outward(mesh.vertices.size(), Vector3d::Zero());
  for (const MeshSide& side : border) {
    const auto& t = mesh.triangles[side.triangle];
    const int a = t[side.corner], b = t[(side.corner + 1) % 3];
    const Vector3d along = (mesh.vertices[b] - mesh.vertices[a]).normalized();
    const Vector3d away = along.cross(flat_normal(mesh, side.triangle));
    outward[a] += away;
    outward[b] += away;
  }
  for (std::size_t v = 0; v < outward.size(); ++v) {
    const Vector3d across = outward[v] - outward[v].dot(mesh.normals[v]) * mesh.normals[v];
    outward[v] = across.norm() > 1e-6 ? Vector3d(across.normalized()) : Vector3d(0, 0, 0);
  }
  return outward;
}

/// One more triangle that looks like triangle `like`, whose corners it takes in the order `from`.
void add_like(PreparedMesh& mesh, int like, const std::array<int, 3>& from,
              const std::array<int, 3>& vertices, const std::array<int, 3>& normals) {
  mesh.triangles.push_back(vertices);
  mesh.corners.push_back(normals);
  if (!mesh.triangle_colours.empty()) mesh.triangle_colours.push_back(Vector3d(mesh.triangle_colours[like]));
  if (mesh.texture) {
    const auto uv = mesh.texture_coordinates[like];
    mesh.texture_coordinates.push_back({uv[from[0]], uv[from[1]], uv[from[2]]});
  }
}

void add_point(PreparedMesh& mesh, int like, const Vector3d& position, double bulge) {
  mesh.vertices.push_back(position);
  if (!mesh.bulges.empty()) mesh.bulges.push_back(bulge);
  if (mesh.colours.size() > 1) mesh.colours.push_back(Vector3d(mesh.colours[like]));
}

/// The inner copy: vertex v has the index v + vertices, its normal n + normals.
void add_inner(PreparedMesh& mesh, double half) {
  const int vertices = int(mesh.vertices.size()), normals = int(mesh.normals.size());
  const int triangles = int(mesh.triangles.size());
  for (int n = 0; n < normals; ++n) mesh.normals.push_back(-Vector3d(mesh.normals[n]));
  for (int v = 0; v < vertices; ++v) {
    const Vector3d p = mesh.vertices[v], step = half * mesh.normals[v];
    add_point(mesh, v, p - step, mesh.bulges.empty() ? 0 : -mesh.bulges[v]);
    mesh.vertices[v] = p + step;
  }
  for (int i = 0; i < triangles; ++i) {
    const auto t = mesh.triangles[i], c = mesh.corners[i];
    add_like(mesh, i, {0, 2, 1}, {t[0] + vertices, t[2] + vertices, t[1] + vertices},
             {c[0] + normals, c[2] + normals, c[1] + normals});
  }
}

/// The vertices of the half round at each vertex of a border, from the outer copy to the inner one, and
/// their normals.
struct Rim {
  std::array<int, rim_quads + 1> vertices, normals;
};

std::vector<Rim> add_rims(PreparedMesh& mesh, const std::vector<Vector3d>& outward, int normals,
                          double half) {
  const int count = int(outward.size());
  std::vector<Rim> rims(outward.size());
  for (int v = 0; v < count; ++v) {
    if (outward[v].isZero()) {  // no border, or one without a direction: the copies are joined straight
      for (int k = 0; k <= rim_quads; ++k)
        rims[v].vertices[k] = v + (2 * k > rim_quads ? count : 0),
        rims[v].normals[k] = v + (2 * k > rim_quads ? normals : 0);
      continue;
    }
    const Vector3d middle = (mesh.vertices[v] + mesh.vertices[v + count]) / 2, n = mesh.normals[v];
    rims[v].vertices.front() = rims[v].normals.front() = v;
    rims[v].vertices.back() = v + count;
    rims[v].normals.back() = v + normals;
    for (int k = 1; k < rim_quads; ++k) {
      const double angle = std::numbers::pi * k / rim_quads;
      const Vector3d d = std::cos(angle) * n + std::sin(angle) * outward[v];
      rims[v].vertices[k] = int(mesh.vertices.size());
      rims[v].normals[k] = int(mesh.normals.size());
      add_point(mesh, v, middle + half * d, 0);
      mesh.normals.push_back(d.normalized());
    }
  }
  return rims;
}

/// A union of sets of numbers: the first of a number's set.
int first_of(std::vector<int>& parents, int i) {
  while (parents[i] != i) i = parents[i] = parents[parents[i]];
  return i;
}

}  // namespace

std::vector<MeshSide> sorted_sides(const PreparedMesh& mesh) {
  std::vector<MeshSide> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax({mesh.triangles[i][k], mesh.triangles[i][(k + 1) % 3]});
      sides.push_back({low, high, int(i), k});
    }
  std::sort(sides.begin(), sides.end(), [](const MeshSide& a, const MeshSide& b) {
    return std::tie(a.low, a.high, a.triangle, a.corner) < std::tie(b.low, b.high, b.triangle, b.corner);
  });
  return sides;
}

void thicken(PreparedMesh& mesh, double half) {
  const std::vector<MeshSide> border = border_sides(mesh);
  const std::vector<Vector3d> outward = outward_directions(mesh, border);
  const int normals = int(mesh.normals.size());
  if (mesh.corners.empty()) mesh.corners = mesh.triangles;
  mesh.first_inner = int(mesh.triangles.size());
  add_inner(mesh, half);
  mesh.first_rim = int(mesh.triangles.size());
  const std::vector<Rim> rims = add_rims(mesh, outward, normals, half);
  for (const MeshSide& side : border) {
    const auto t = mesh.triangles[side.triangle];
    const int i = side.corner, j = (i + 1) % 3;
    const Rim &a = rims[t[i]], &b = rims[t[j]];
    for (int k = 0; k < rim_quads; ++k) {
      if (a.vertices[k] != a.vertices[k + 1])
        add_like(mesh, side.triangle, {j, i, i}, {b.vertices[k], a.vertices[k], a.vertices[k + 1]},
                 {b.normals[k], a.normals[k], a.normals[k + 1]});
      if (b.vertices[k] != b.vertices[k + 1])
        add_like(mesh, side.triangle, {j, i, j}, {b.vertices[k], a.vertices[k + 1], b.vertices[k + 1]},
                 {b.normals[k], a.normals[k + 1], b.normals[k + 1]});
    }
  }
}

void split_normals(PreparedMesh& mesh) {
  constexpr double sharp_cosine = 0.5;  // of 60 degrees
  const std::vector<MeshSide> sides = sorted_sides(mesh);
  std::vector<int> parents(3 * mesh.triangles.size());
  for (std::size_t i = 0; i < parents.size(); ++i) parents[i] = int(i);
  std::vector<bool> is_sharp(mesh.vertices.size(), false);
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    const MeshSide &a = sides[i], &b = sides[i + 1];
    if (a.low != b.low || a.high != b.high) continue;
    const int a0 = 3 * a.triangle + a.corner, a1 = 3 * a.triangle + (a.corner + 1) % 3;
    const int b0 = 3 * b.triangle + b.corner, b1 = 3 * b.triangle + (b.corner + 1) % 3;
    const bool opposite = mesh.triangles[a.triangle][a.corner] != mesh.triangles[b.triangle][b.corner];
    if (opposite && flat_normal(mesh, a.triangle).dot(flat_normal(mesh, b.triangle)) < sharp_cosine) {
      is_sharp[a.low] = is_sharp[a.high] = true;
      continue;
    }
    parents[first_of(parents, opposite ? b1 : b0)] = first_of(parents, a0);
    parents[first_of(parents, opposite ? b0 : b1)] = first_of(parents, a1);
  }
  std::vector<int> normal_of(parents.size(), -1);  // of a set of corners, by its first
  for (int c = 0; c < int(parents.size()); ++c) {
    const int triangle = c / 3, i = c % 3;
    const auto& t = mesh.triangles[triangle];
    if (!is_sharp[t[i]]) continue;
    if (mesh.corners.empty()) mesh.corners = mesh.triangles;
    int& normal = normal_of[first_of(parents, c)];
    if (normal < 0) {
      normal = int(mesh.normals.size());
      mesh.normals.push_back(Vector3d::Zero());
    }
    const Vector3d a = mesh.vertices[t[(i + 1) % 3]] - mesh.vertices[t[i]];
    const Vector3d b = mesh.vertices[t[(i + 2) % 3]] - mesh.vertices[t[i]];
    mesh.normals[normal] += std::atan2(a.cross(b).norm(), a.dot(b)) * flat_normal(mesh, triangle);
    mesh.corners[triangle][i] = normal;
  }
  for (std::size_t n = mesh.vertices.size(); n < mesh.normals.size(); ++n)
    mesh.normals[n] =
        mesh.normals[n].norm() > 1e-6 ? Vector3d(mesh.normals[n].normalized()) : Vector3d(0, 0, 0);
}

}  // namespace furrow::io
