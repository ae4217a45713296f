// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "io/mesh/ply_rows.h"
#include "io/mesh/soup_to_mesh.h"

namespace furrow::io {

/// The vertex columns of a saved state: the maps of geometry/mesh/property_names.h that belong to a cloth in
/// motion, as scalars (vx, vy, vz, …). In SI units whatever the unit of the positions; states are in metres,
/// y up.
class PlyMotion {
 public:
  /// Finds the columns in a file's element.
  void set_columns(const PlyElement& element);
  /// The names of all columns that there may be.
  static const std::vector<std::string>& names();
  /// Of those that were found, the ones that are used: whole vectors, and the contact level.
  std::vector<std::string> used() const;
  void add(const PlyRow& row, const PlyRows& rows);
  void fill_maps(SoupMesh& mesh) const;

 private:
  std::vector<std::optional<std::size_t>> columns_;
  std::vector<double> values_;  // names().size() a vertex; NaN where the file has no such column
};

/// Throws geometry::ContentError for a vertex attribute (vertex_attributes.h) that is named like one of these
/// columns: a state with both could not be read again.
void check_state_attributes(const geometry::Mesh& mesh);

/// The declarations of the columns that this mesh has, and the numbers of one vertex after the other.
std::string ply_motion_header(const geometry::Mesh& mesh);
void put_ply_motion(const geometry::Mesh& mesh, geometry::Vertex v, const std::function<void(double)>& put);

}  // namespace furrow::io
