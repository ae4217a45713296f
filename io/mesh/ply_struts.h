// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <string>
#include <vector>

#include "geometry/mesh/struts.h"
#include "io/mesh/ply_rows.h"
#include "io/mesh/soup_to_mesh.h"

namespace furrow::io {

/// The `strut` element of our PLY files: vertex1, vertex2, rest_length, stiffness (geometry/mesh/struts.h).
class PlyStruts {
 public:
  /// Whether the element has all four columns.
  bool set_columns(const PlyElement& element);
  static std::vector<std::string> names();
  /// Throws geometry::ContentError for a value out of its range, or two equal ends.
  void add(const PlyRow& row, const PlyRows& rows, double metres_per_unit);

  /// Sets the struts; vertices keep the file's indices. Throws geometry::ContentError for a strut that names
  /// a vertex beyond the last of `vertices`, those of the file.
  void set(SoupMesh& mesh, std::size_t vertices, const std::string& name) const;

 private:
  struct Values {
    std::size_t a, b;
    double rest_length, stiffness;
  };
  std::vector<Values> struts_;
  std::array<std::size_t, 4> columns_{};
};

}  // namespace furrow::io
