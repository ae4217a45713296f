// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/ply_triangles.h"

#include <cmath>

#include "io/mesh/ply_edges.h"

namespace furrow::io {

bool PlyTriangles::set_columns(const PlyElement& element) {
  std::array<std::size_t, 3> columns{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto column = find_column(element, {ply_triangle_lengths[k]}, PlyKind::number);
    if (!column) return false;
    columns[k] = *column;
  }
  columns_ = columns;
  return true;
}

void PlyTriangles::add(const PlyRow& row, const PlyRows& rows, std::size_t corners, double metres_per_unit,
                       PolygonSoup& soup) const {
  if (!columns_) return;
  for (const std::size_t column : *columns_) {
    const double value = checked_rest_length(row.numbers[column], rows, metres_per_unit);
    if (corners == 3) soup.triangle_rest_lengths.push_back(value);
    if (corners != 3 && !std::isnan(value)) rows.fail("only triangles have rest lengths of their own");
  }
  soup.triangle_rest_lengths.resize(soup.corners.size(), geometry::unset_value);
}

}  // namespace furrow::io
