// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <optional>
#include <string>

#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

/// What a mesh is, in numbers. Removed elements do not count.
struct MeshInfo {
  std::size_t vertices = 0, edges = 0, faces = 0;
  std::size_t isolated_vertices = 0;  ///< vertices of no face
  std::size_t components = 0;         ///< sets of faces joined through edges
  std::size_t boundary_loops = 0;
  long euler_characteristic = 0;  ///< vertices that have faces - edges + faces
  bool closed = false;            ///< it has faces and no border
  bool manifold = true;           ///< the faces around every vertex are one fan (edges always are manifold)
  std::size_t degenerate_faces = 0;          ///< as degenerate_faces.h has it
  double area = 0;                           ///< [m^2]
  std::optional<double> volume;              ///< of a closed mesh [m^3]; > 0 if the faces wind outward
  Point box_min{0, 0, 0}, box_max{0, 0, 0};  ///< corners of the bounding box [m]; 0 without vertices
  double mean_edge_length = 0;               ///< [m]; 0 without edges
  double min_angle_deg = 0;                  ///< smallest corner of a face; 0 without faces
};

/// Measures the present shape. Sums run in the order of the indices. O(vertices + edges).
/// Throws ContentError if a position is not finite or a face no triangle.
MeshInfo measure(const Mesh& mesh);

/// A length as people write it, to three digits: "0.04 mm", "3.6 mm", "130 mm", "1.75 m", "1700 m".
/// Millimetres below a metre; an exponent only for what no person measures: below a micrometre, above 1000
/// km.
std::string length_text(double metres);

}  // namespace furrow::geometry
