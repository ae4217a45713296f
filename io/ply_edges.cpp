// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/ply_edges.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "geometry/errors.h"

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

double length(const PlyRow& row, std::optional<std::size_t> column, const PlyRows& rows,
              double metres_per_unit) {
  if (!column) return kUnset;
  const double value = row.numbers[*column] * metres_per_unit;
  if (value <= 0 || std::isinf(value)) rows.fail("a rest length must be > 0 and finite, or nan for none");
  return value;
}

double angle(const PlyRow& row, std::optional<std::size_t> column, const PlyRows& rows) {
  if (!column) return kUnset;
  const double value = row.numbers[*column];
  if (std::abs(value) > std::numbers::pi) rows.fail("a rest angle must be in [-pi, pi], or nan for none");
  return value;
}

int small_count(const PlyRow& row, std::optional<std::size_t> column, const PlyRows& rows) {
  if (!column) return 0;
  const double value = row.numbers[*column];
  if (!(value >= 0 && value <= 1e6) || value != std::floor(value))
    rows.fail("a count must be whole, from 0 to 1e6");
  return static_cast<int>(value);
}

}  // namespace

bool PlyEdges::set_columns(const PlyElement& element) {
  vertex1_ = find_column(element, {"vertex1"}, PlyKind::number);
  vertex2_ = find_column(element, {"vertex2"}, PlyKind::number);
  rest_length_ = find_column(element, {"rest_length"}, PlyKind::number);
  bending_rest_length_ = find_column(element, {"bending_rest_length"}, PlyKind::number);
  bending_count_ = find_column(element, {"bending_count"}, PlyKind::number);
  rest_angle_ = find_column(element, {"rest_angle"}, PlyKind::number);
  line_edge_ = find_column(element, {"line_edge"}, PlyKind::number);
  return vertex1_ && vertex2_ &&
         (rest_length_ || bending_rest_length_ || bending_count_ || rest_angle_ || line_edge_);
}

void PlyEdges::add(const PlyRow& row, const PlyRows& rows, double metres_per_unit) {
  const double a = row.numbers[*vertex1_], b = row.numbers[*vertex2_];
  const auto is_index = [](double x) { return x >= 0 && x < 9e15 && x == std::floor(x); };
  if (!is_index(a) || !is_index(b)) rows.fail("an end of an edge is no index of a vertex; correct it");
  edges_.push_back({static_cast<std::size_t>(std::min(a, b)), static_cast<std::size_t>(std::max(a, b)),
                    length(row, rest_length_, rows, metres_per_unit),
                    length(row, bending_rest_length_, rows, metres_per_unit), angle(row, rest_angle_, rows),
                    small_count(row, bending_count_, rows), small_count(row, line_edge_, rows)});
}

void PlyEdges::fill_maps(SoupMesh& mesh, const std::string& name) const {
  std::optional<EdgeMap<double>> rest_length, bending_rest_length, rest_angle;
  std::optional<EdgeMap<int>> bending_count;
  std::optional<EdgeMap<bool>> line_edge;
  if (rest_length_) rest_length = ensure_map(mesh.mesh, kRestLength);
  if (bending_rest_length_) bending_rest_length = ensure_map(mesh.mesh, kBendingRestLength);
  if (bending_count_) bending_count = ensure_map(mesh.mesh, kBendingCount);
  if (rest_angle_) rest_angle = ensure_map(mesh.mesh, kRestAngle);
  if (line_edge_) line_edge = ensure_map(mesh.mesh, kLineEdge);
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
      if (rest_length) (*rest_length)[m.edge] = e.rest_length;
      if (bending_rest_length) (*bending_rest_length)[m.edge] = e.bending_rest_length;
      if (bending_count) (*bending_count)[m.edge] = e.bending_count;
      if (rest_angle) (*rest_angle)[m.edge] = e.rest_angle;
      if (line_edge) (*line_edge)[m.edge] = e.line_edge != 0;
    }
  }
}

}  // namespace furrow::io
