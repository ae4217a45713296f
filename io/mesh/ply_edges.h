// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <span>
#include <string>
#include <vector>

#include "geometry/mesh/property_names.h"
#include "io/mesh/ply_rows.h"
#include "io/mesh/soup_to_mesh.h"

namespace furrow::io {

/// A number of an edge that is a column of the file and a map of the mesh. NaN is unset.
struct PlyEdgeNumber {
  enum class Kind { length, angle, stiffness };
  const char* name;
  geometry::PropertyName<geometry::Edge, double> map;
  Kind kind;  ///< lengths are in the file's unit, angles and stiffnesses in SI units
};
/// In the order in which they are written.
std::span<const PlyEdgeNumber> ply_edge_numbers();

/// Rest lengths [m] and stiffnesses of elements: the value, or NaN where nothing is set. Throw
/// geometry::ContentError for what is <= 0 or < 0, or infinite.
double checked_rest_length(double value, const PlyRows& rows, double metres_per_unit);
double checked_stiffness(double value, const PlyRows& rows);

/// The `edge` element of our PLY files: vertex1, vertex2 and the edge maps of geometry/mesh/property_names.h.
class PlyEdges {
 public:
  /// Whether the element has any column that we read.
  bool set_columns(const PlyElement& element);
  /// The names of all columns that we read.
  static std::vector<std::string> names();
  void add(const PlyRow& row, const PlyRows& rows, double metres_per_unit);

  /// Fills the maps. An edge of the file stands for every edge of the mesh between copies of its two points.
  /// Throws geometry::ContentError for an edge that the mesh lacks.
  void fill_maps(SoupMesh& mesh, const std::string& name) const;

 private:
  static constexpr std::size_t number_columns = 7;
  struct Values {
    std::size_t a, b;
    std::array<double, number_columns> numbers;
    int bending_count, line_edge, diagonal;
  };
  std::vector<Values> edges_;
  std::array<std::optional<std::size_t>, number_columns> numbers_;
  std::optional<std::size_t> vertex1_, vertex2_, bending_count_, line_edge_, diagonal_;
};

}  // namespace furrow::io
