// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "geometry/mesh/mesh.h"
#include "geometry/stroke/stroke.h"

namespace furrow::tests {

/// A mesh over the unit square of (s, t), and where a point of the square comes to lie in space.
struct MeshCase {
  std::string name;
  geometry::Mesh mesh;
  std::function<geometry::Point(double, double)> place;
  bool flat = true;    ///< in the plane z = 0, normals up
  bool ring = false;   ///< s = 0 and s = 1 are the same
  double edge = 0.05;  ///< about the mean edge [m]
};

/// Rows of equilateral triangles over 1 x 1 m; `jitter` moves inner vertices by up to that part of an edge.
geometry::Mesh regular_sheet(int columns, double jitter = 0, std::uint64_t seed = 1);
/// A square grid whose diagonals alternate.
geometry::Mesh union_jack_sheet(int columns);
/// Remeshed by CGAL from a jittered sheet; no two vertices alike.
geometry::Mesh irregular_sheet(int columns);
/// Axis y, height 1 m, circumference 1 m, open at both ends.
geometry::Mesh cylinder(int around);
/// Closed, of genus 1, all valences 6.
geometry::Mesh torus(int around, int across);
geometry::Mesh icosahedron();
/// A jittered grid with random diagonals over 1 x 1 m, lifted to a random wave; all angles at least
/// `least_angle_deg`.
geometry::Mesh random_sheet(std::uint64_t seed, double least_angle_deg);

/// The five meshes of the insertion table.
std::vector<MeshCase> mesh_zoo();

struct StrokeCase {
  std::string name;
  std::vector<geometry::Stroke> strokes;  ///< drawn in this order
};
/// The eight kinds of strokes of the insertion table.
std::vector<StrokeCase> strokes_for(const MeshCase& on);

geometry::Stroke stroke_through(const MeshCase& on, const std::vector<std::array<double, 2>>& square_points);
geometry::Vertex nearest_vertex(const geometry::Mesh& mesh, const geometry::Point& p);

}  // namespace furrow::tests
