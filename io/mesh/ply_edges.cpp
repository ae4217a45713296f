// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/ply_edges.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "geometry/mesh/errors.h"

namespace furrow::io {
namespace {

using namespace geometry;

struct MeshEdge {
  std::size_t a, b;  ///< the soup's points, a <= b
  Edge edge;
};

std::vector<MeshEdge> sorted_edges(const SoupMesh& mesh) {
  std::vector<MeshEdge> edges;
  edges.reserve(mesh.mesh.number_of_edges());
  for (const Edge e : mesh.mesh.edges()) {
    const std::size_t a = mesh.origin[mesh.mesh.vertex(e, 0)], b = mesh.origin[mesh.mesh.vertex(e, 1)];
    edges.push_back({std::min(a, b), std::max(a, b), e});
  }
  std::ranges::sort(edges, [](const MeshEdge& p, const MeshEdge& q) {
    return std::tie(p.a, p.b, p.edge) < std::tie(q.a, q.b, q.edge);
  });
  return edges;
}

constexpr std::array<PlyEdgeNumber, 7> edge_numbers = {
    {{"rest_length", attribute::rest_length, PlyEdgeNumber::Kind::length},
     {"bending_rest_length", attribute::bending_rest_length, PlyEdgeNumber::Kind::length},
     {"rest_angle", attribute::rest_angle, PlyEdgeNumber::Kind::angle},
     {"stiffness", attribute::stiffness, PlyEdgeNumber::Kind::stiffness},
     {"bending_stiffness", attribute::bending_stiffness, PlyEdgeNumber::Kind::stiffness},
     {"hinge_stiffness", attribute::hinge_stiffness, PlyEdgeNumber::Kind::stiffness},
     {"tension", attribute::tension, PlyEdgeNumber::Kind::stiffness}}};

double checked(const PlyEdgeNumber& number, double value, const PlyRows& rows, double metres_per_unit) {
  switch (number.kind) {
    case PlyEdgeNumber::Kind::length:
      return checked_rest_length(value, rows, metres_per_unit);
    case PlyEdgeNumber::Kind::stiffness:
      return checked_stiffness(value, rows);
    default:
      if (std::abs(value) > std::numbers::pi) rows.fail("a rest angle must be in [-pi, pi], or nan for none");
      return value;
  }
}

int small_count(const PlyRow& row, std::optional<std::size_t> column, const PlyRows& rows) {
  if (!column) return 0;
  const double value = row.numbers[*column];
  if (!(value >= 0 && value <= 1e6) || value != std::floor(value))
    rows.fail("a count must be whole, from 0 to 1e6");
  return static_cast<int>(value);
}

}  // namespace

std::span<const PlyEdgeNumber> ply_edge_numbers() { return edge_numbers; }

double checked_rest_length(double value, const PlyRows& rows, double metres_per_unit) {
  const double metres = value * metres_per_unit;
  if (metres <= 0 || std::isinf(metres)) rows.fail("a rest length must be > 0 and finite, or nan for none");
  return metres;
}

double checked_stiffness(double value, const PlyRows& rows) {
  if (value < 0 || std::isinf(value)) rows.fail("a stiffness must be >= 0 and finite, or nan for none");
  return value;
}

bool PlyEdges::set_columns(const PlyElement& element) {
  const auto column = [&](const char* name) { return find_column(element, {name}, PlyKind::number); };
  vertex1_ = column("vertex1");
  vertex2_ = column("vertex2");
  bending_count_ = column("bending_count");
  line_edge_ = column("line_edge");
  diagonal_ = column("diagonal");
  bool any = bending_count_ || line_edge_ || diagonal_;
  for (std::size_t k = 0; k < number_columns; ++k) {
    numbers_[k] = column(edge_numbers[k].name);
    any = any || numbers_[k];
  }
  return vertex1_ && vertex2_ && any;
}

std::vector<std::string> PlyEdges::names() {
  std::vector<std::string> names{"vertex1", "vertex2", "bending_count", "line_edge", "diagonal"};
  for (const PlyEdgeNumber& number : edge_numbers) names.emplace_back(number.name);
  return names;
}

void PlyEdges::add(const PlyRow& row, const PlyRows& rows, double metres_per_unit) {
  const double a = row.numbers[*vertex1_], b = row.numbers[*vertex2_];
  const auto is_index = [](double x) { return x >= 0 && x < 9e15 && x == std::floor(x); };
  if (!is_index(a) || !is_index(b)) rows.fail("an end of an edge is no index of a vertex; correct it");
  Values values{
      static_cast<std::size_t>(std::min(a, b)), static_cast<std::size_t>(std::max(a, b)), {}, 0, 0, 0};
  for (std::size_t k = 0; k < number_columns; ++k)
    values.numbers[k] = numbers_[k]
                            ? checked(edge_numbers[k], row.numbers[*numbers_[k]], rows, metres_per_unit)
                            : unset_value;
  values.bending_count = small_count(row, bending_count_, rows);
  values.line_edge = small_count(row, line_edge_, rows);
  values.diagonal = small_count(row, diagonal_, rows);
  edges_.push_back(values);
}

void PlyEdges::fill_maps(SoupMesh& mesh, const std::string& name) const {
  std::array<std::optional<EdgeMap<double>>, number_columns> maps;
  std::optional<EdgeMap<int>> bending_count;
  std::optional<EdgeMap<bool>> line_edge, diagonal;
  for (std::size_t k = 0; k < number_columns; ++k)
    if (numbers_[k]) maps[k] = ensure_map(mesh.mesh, edge_numbers[k].map);
  if (bending_count_) bending_count = ensure_map(mesh.mesh, attribute::bending_count);
  if (line_edge_) line_edge = ensure_map(mesh.mesh, attribute::line_edge);
  if (diagonal_) diagonal = ensure_map(mesh.mesh, attribute::diagonal);
  if (edges_.empty()) return;
  const std::vector<MeshEdge> sorted = sorted_edges(mesh);
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const Values& e = edges_[i];
    const auto same = std::ranges::equal_range(sorted, std::pair(e.a, e.b), {},
                                               [](const MeshEdge& m) { return std::pair(m.a, m.b); });
    if (same.empty())
      throw ContentError(name + ": edge " + std::to_string(i) + ": no face has an edge between vertices " +
                         std::to_string(e.a) + " and " + std::to_string(e.b) + "; remove it");
    for (const MeshEdge& m : same) {
      for (std::size_t k = 0; k < number_columns; ++k)
        if (maps[k]) (*maps[k])[m.edge] = e.numbers[k];
      if (bending_count) (*bending_count)[m.edge] = e.bending_count;
      if (line_edge) (*line_edge)[m.edge] = e.line_edge != 0;
      if (diagonal) (*diagonal)[m.edge] = e.diagonal != 0;
    }
  }
}

}  // namespace furrow::io
