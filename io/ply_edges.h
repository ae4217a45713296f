// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "geometry/property_names.h"
#include "io/ply_rows.h"
#include "io/soup_to_mesh.h"

namespace furrow::io {

/// The `edge` element of our PLY files: vertex1, vertex2 and the edge maps of geometry/property_names.h.
class PlyEdges {
 public:
  /// Whether the element has any column that we read.
  bool set_columns(const PlyElement& element);
  void add(const PlyRow& row, const PlyRows& rows, double metres_per_unit);

  /// Fills the maps. An edge of the file stands for every edge of the mesh between copies of its two points.
  /// Throws geometry::ContentError for an edge that the mesh lacks.
  void fill_maps(SoupMesh& mesh, const std::string& name) const;

 private:
  struct Values {
    std::size_t a, b;
    double rest_length, bending_rest_length, rest_angle;
    int bending_count, line_edge;
  };
  std::vector<Values> edges_;
  std::optional<std::size_t> vertex1_, vertex2_, rest_length_, bending_rest_length_, bending_count_,
      rest_angle_, line_edge_;
};

}  // namespace furrow::io
