// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/sheet.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "geometry/mesh/measures.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/property_names.h"

namespace furrow::geometry {
namespace {

std::vector<Vertex> add_row(Mesh& mesh, int columns, bool shifted, double width, double y) {
  std::vector<Vertex> row;
  const auto add = [&](double column) {
    row.push_back(mesh.add_vertex(Point((column / columns - 0.5) * width, y, 0)));
  };
  if (!shifted)
    for (int i = 0; i <= columns; ++i) add(i);
  else {
    add(0);
    for (int i = 0; i < columns; ++i) add(i + 0.5);
    add(columns);
  }
  return row;
}

void check_lengths(const char* name, double width, double height, double edge) {
  for (double length : {width, height, edge})
    if (!(length > 0) || !std::isfinite(length)) refuse(name, "a length is " + length_text(length));
}

}  // namespace

Mesh equilateral_sheet(double width, double height, double edge) {
  check_lengths("equilateral_sheet", width, height, edge);
  const double across = std::round(width / edge),
               upwards = std::round(height / (edge * std::numbers::sqrt3 / 2));
  if (edge > width || (across + 2) * (upwards + 1) > 1e7)
    refuse("equilateral_sheet", "edge is " + length_text(edge) + " for a width of " + length_text(width) +
                                    " and a height of " + length_text(height));
  const int columns = static_cast<int>(across), rows = std::max(1, static_cast<int>(upwards));
  Mesh mesh;
  std::vector<Vertex> below = add_row(mesh, columns, false, width, 0);
  for (int j = 1; j <= rows; ++j) {
    const bool shifted = j % 2 == 1;
    const std::vector<Vertex> row =
        add_row(mesh, columns, shifted, width, j == rows ? height : height * j / rows);
    // Of the two rows, the shifted one has a vertex more: each of its edges meets one vertex of the other.
    const std::vector<Vertex>& longer = shifted ? row : below;
    const std::vector<Vertex>& shorter = shifted ? below : row;
    for (std::size_t i = 0; i < shorter.size(); ++i) {
      if (shifted)
        mesh.add_face(shorter[i], longer[i + 1], longer[i]);
      else
        mesh.add_face(longer[i], longer[i + 1], shorter[i]);
      if (i + 1 == shorter.size()) break;
      if (shifted)
        mesh.add_face(shorter[i], shorter[i + 1], longer[i + 1]);
      else
        mesh.add_face(longer[i + 1], shorter[i + 1], shorter[i]);
    }
    below = row;
  }
  return mesh;
}

Mesh woven_sheet(double width, double height, double edge) {
  check_lengths("woven_sheet", width, height, edge);
  const double across = std::round(width / edge), upwards = std::round(height / edge);
  if (edge > width || edge > height || (across + 1) * (upwards + 1) > 1e7)
    refuse("woven_sheet", "edge is " + length_text(edge) + " for a width of " + length_text(width) +
                              " and a height of " + length_text(height));
  const int columns = static_cast<int>(across), rows = static_cast<int>(upwards);
  Mesh mesh;
  std::vector<Vertex> below = add_row(mesh, columns, false, width, 0);
  auto diagonal = ensure_map(mesh, attribute::diagonal);
  for (int j = 0; j < rows; ++j) {
    const double y = j + 1 == rows ? height : height * (j + 1) / rows;
    const std::vector<Vertex> above = add_row(mesh, columns, false, width, y);
    for (std::size_t i = 0; i < static_cast<std::size_t>(columns); ++i) {
      const Vertex a = below[i], b = below[i + 1], c = above[i + 1], d = above[i];
      const bool rises = (i + static_cast<std::size_t>(j)) % 2 == 0;  // the diagonal from a to c
      mesh.add_face(a, b, rises ? c : d);
      mesh.add_face(rises ? a : b, c, d);
      diagonal[mesh.edge(rises ? mesh.halfedge(a, c) : mesh.halfedge(b, d))] = true;
    }
    below = above;
  }
  return mesh;
}

}  // namespace furrow::geometry
