// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "geometry/mesh/mesh.h"

/// The zoo: meshes by kind, all of triangles, wound counter-clockwise from outside (flat ones from +z).
/// The equilateral sheet is geometry/mesh/sheet.h.
namespace furrow::tests {

/// From plain arrays; throws std::logic_error for a face that the half-edge structure refuses.
geometry::Mesh mesh_of(const std::vector<geometry::Point>& points,
                       const std::vector<std::array<int, 3>>& faces);

/// One triangle of sides 1, 1 and sqrt(2) [m].
geometry::Mesh single_triangle();
/// nx x ny cells of width x height [m] in all, from the origin; all diagonals run the same way.
geometry::Mesh grid(int nx, int ny, double width = 1, double height = 1);
/// The same with diagonals that alternate like a union jack: valences of four and eight.
geometry::Mesh union_jack(int nx, int ny, double width = 1, double height = 1);
/// A grid whose inner vertices are moved in the plane by up to `amount` cells (< 0.5; faces may turn over
/// from 0.25 on), the same for the same seed.
geometry::Mesh jittered(int nx, int ny, double amount, unsigned seed, double width = 1, double height = 1);
/// Open tube around the y axis from y = 0, `around` x `up` cells.
geometry::Mesh cylinder(double radius, double height, int around, int up);
/// Icosahedron split `levels` times into four, on the sphere of that radius around `center`.
geometry::Mesh icosphere(int levels, double radius = 1, const geometry::Point& center = {0, 0, 0});
/// Closed six-valent lattice of n x m vertices; vertex i + n j lies at angle 2 pi i / n around the y axis and
/// 2 pi j / m around the tube.
geometry::Mesh torus_lattice(int n, int m, double major = 1, double minor = 0.4);
/// [0, 1]^3 with 12 faces.
geometry::Mesh cube();

/// Adds the faces of `part` as components of their own; positions and connectivity only.
void append(geometry::Mesh& mesh, const geometry::Mesh& part);
/// z += height(x, y) for every vertex.
template <class Height>
void lift(geometry::Mesh& mesh, const Height& height) {
  for (auto v : mesh.vertices()) {
    const geometry::Point p = mesh.point(v);
    mesh.point(v) = {p.x(), p.y(), p.z() + height(p.x(), p.y())};
  }
}

/// v and f lines of an OBJ file, polygons as fans; nothing else.
geometry::Mesh read_plain_obj(const std::filesystem::path& path);

}  // namespace furrow::tests
