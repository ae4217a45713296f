// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

namespace furrow::physics {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// Mass points. All arrays have one entry a particle.
struct Particles {
  std::vector<Vec3> x;           ///< positions [m]
  std::vector<Vec3> v;           ///< velocities [m/s]
  std::vector<double> mass;      ///< [kg]; > 0, but 0 for a vertex that no face uses
  std::vector<double> inv_mass;  ///< [1/kg]; 0 = pinned: it moves only as World::pins leads it

  std::size_t size() const { return x.size(); }
};

/// A triangle soup as plain arrays; faces are counter-clockwise seen from outside. Vertices may be doubled.
struct TriangleMesh {
  std::vector<Vec3> vertices;                 ///< [m]
  std::vector<std::array<int, 3>> triangles;  ///< vertex indices
};

/// Throws std::invalid_argument, with `who` and the place in the message, when there is no triangle, an index
/// is out of range, a used coordinate is not finite or beyond 1e9 m, or no triangle has an area. Cost O(V +
/// T).
void check_body(const TriangleMesh& mesh, const char* who);

/// Length of the diagonal of the bounding box of the used vertices [m].
double bounding_diagonal(const TriangleMesh& mesh);

/// Of each vertex the sum over its triangles of their normals, twice their areas long [m^2]; 0 where it has
/// none. Cost O(V + T).
std::vector<Vec3> vertex_normals(std::span<const std::array<int, 3>> triangles, std::span<const Vec3> x);

}  // namespace furrow::physics
