// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/ply_struts.h"

#include <algorithm>
#include <cmath>

#include "geometry/mesh/errors.h"
#include "io/mesh/ply_edges.h"

namespace furrow::io {

using namespace geometry;

namespace {

constexpr std::array<const char*, 4> column_names = {"vertex1", "vertex2", "rest_length", "stiffness"};

}  // namespace

std::vector<std::string> PlyStruts::names() { return {column_names.begin(), column_names.end()}; }

bool PlyStruts::set_columns(const PlyElement& element) {
  std::size_t k = 0;
  for (const char* name : column_names) {
    const auto column = find_column(element, {name}, PlyKind::number);
    if (!column) return false;
    columns_[k++] = *column;
  }
  return true;
}

void PlyStruts::add(const PlyRow& row, const PlyRows& rows, double metres_per_unit) {
  const double a = row.numbers[columns_[0]], b = row.numbers[columns_[1]];
  const auto is_index = [](double x) { return x >= 0 && x < 9e15 && x == std::floor(x); };
  if (!is_index(a) || !is_index(b)) rows.fail("an end of a strut is no index of a vertex; correct it");
  if (a == b) rows.fail("both ends of a strut are one vertex; remove it");
  const double rest = checked_rest_length(row.numbers[columns_[2]], rows, metres_per_unit);
  const double stiffness = checked_stiffness(row.numbers[columns_[3]], rows);
  if (std::isnan(rest) || std::isnan(stiffness)) rows.fail("a strut needs a rest length and a stiffness");
  struts_.push_back(
      {static_cast<std::size_t>(std::min(a, b)), static_cast<std::size_t>(std::max(a, b)), rest, stiffness});
}

void PlyStruts::set(SoupMesh& mesh, std::size_t vertices, const std::string& name) const {
  std::vector<Strut> list;
  const auto vertex = [](std::size_t i) { return Vertex(static_cast<Vertex::size_type>(i)); };
  for (std::size_t i = 0; i < struts_.size(); ++i) {
    const Values& s = struts_[i];
    if (s.b >= vertices)
      throw ContentError(name + ": strut " + std::to_string(i) + ": names vertex " + std::to_string(s.b) +
                         " of " + std::to_string(vertices) + "; correct or remove it");
    list.push_back({vertex(s.a), vertex(s.b), s.rest_length, s.stiffness});
  }
  set_struts(mesh.mesh, list);
}

}  // namespace furrow::io
