// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <optional>

#include "io/mesh/ply_rows.h"
#include "io/mesh/polygon_soup.h"

namespace furrow::io {

/// The columns of a face for the rest lengths of its own (geometry::attribute::triangle_rest_length): of the
/// edges between corners 0 and 1, 1 and 2, 2 and 0 of its vertex_indices.
inline constexpr std::array<const char*, 3> ply_triangle_lengths = {"rest_length_01", "rest_length_12",
                                                                    "rest_length_20"};

class PlyTriangles {
 public:
  /// Whether the element has all three.
  bool set_columns(const PlyElement& element);
  /// Adds those of the face of so many corners that was pushed last to the soup; nothing without columns.
  /// Throws geometry::ContentError for a length that is set where there are not three corners, or not > 0.
  void add(const PlyRow& row, const PlyRows& rows, std::size_t corners, double metres_per_unit,
           PolygonSoup& soup) const;

 private:
  std::optional<std::array<std::size_t, 3>> columns_;
};

}  // namespace furrow::io
