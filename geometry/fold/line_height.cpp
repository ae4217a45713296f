// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/line_height.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "geometry/fold/line_region.h"
#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/two_ring.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// The cloth around one line: `free` are the line's vertices and those that its fold moves.
struct HeightPatch {
  std::vector<Vertex> line, free;
  std::vector<int> index;   ///< by vertex: its place in `free`, or -1
  std::vector<Face> faces;  ///< around the free vertices
};

HeightPatch gather_patch(const Mesh& mesh, std::vector<Vertex> line, const std::vector<Vertex>& free) {
  HeightPatch patch{std::move(line), {}, std::vector<int>(mesh.num_vertices(), -1), {}};
  for (Vertex v : free) {
    if (mesh.is_isolated(v)) continue;
    patch.index[v.idx()] = static_cast<int>(patch.free.size());
    patch.free.push_back(v);
    for (Face f : mesh.faces_around_target(mesh.halfedge(v)))
      if (f.is_valid()) patch.faces.push_back(f);
  }
  std::sort(patch.faces.begin(), patch.faces.end());
  patch.faces.erase(std::unique(patch.faces.begin(), patch.faces.end()), patch.faces.end());
  return patch;
}

/// Positions of patch.free that solve the Laplace equation; empty where it has no single solution.
Eigen::MatrixXd harmonic_fill(const Mesh& mesh, const HeightPatch& patch,
                              const std::vector<double>& lengths) {
  const auto n = static_cast<Eigen::Index>(patch.free.size());
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n, 3);
  for (Face f : patch.faces) {
    physics::throw_if_cancelled("line_heights");
    const Halfedge first = mesh.halfedge(f);
    const auto [a, b, c] = edge_lengths(mesh, f, lengths);
    const auto cot = bounded_cotangents(a, b, c);  // opposite first, next, prev
    Halfedge h = first;
    for (double cotangent : cot) {
      const double w = 0.5 * cotangent;
      const Vertex ends[2] = {mesh.source(h), mesh.target(h)};
      for (int side : {0, 1}) {
        const int i = patch.index[ends[side].idx()], j = patch.index[ends[1 - side].idx()];
        if (i < 0) continue;
        entries.emplace_back(i, i, w);
        const Point& p = mesh.point(ends[1 - side]);
        if (j >= 0)
          entries.emplace_back(i, j, -w);
        else
          right.row(i) += w * Eigen::RowVector3d(p.x(), p.y(), p.z());
      }
      h = mesh.next(h);
    }
  }
  Sparse matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Sparse> solver(matrix);
  if (solver.info() != Eigen::Success) return {};
  const auto pivots = solver.vectorD();
  if (!(pivots.minCoeff() > 1e-12 * pivots.maxCoeff())) return {};  // a part that nothing bounds
  return solver.solve(right);
}

/// A fold along a border has its foot on one side alone; the fill then shrinks towards that, and its normals
/// mean nothing. True where it has less than a quarter of the cloth's area before lines around the line.
bool has_shrunk(const Mesh& mesh, const HeightPatch& patch, double fill_area) {
  const auto is_border = [&](Vertex v) { return mesh.is_border(v); };
  if (std::none_of(patch.free.begin(), patch.free.end(), is_border)) return false;
  const std::vector<double> lengths = lengths_before_lines(mesh);
  double area = 0;
  for (Vertex v : patch.line)
    for (Face f : mesh.faces_around_target(mesh.halfedge(v)))
      if (f.is_valid()) {
        const auto [a, b, c] = edge_lengths(mesh, f, lengths);
        area += triangle_area(a, b, c);
      }
  return fill_area < 0.25 * area;
}

/// NaN where the fill is none.
double mean_height(const Mesh& mesh, const HeightPatch& patch, const Eigen::MatrixXd& fill) {
  const auto position = [&](Vertex v) {
    const int i = patch.index[v.idx()];
    return i < 0 ? mesh.point(v) : Point(fill(i, 0), fill(i, 1), fill(i, 2));
  };
  double sum = 0, fill_area = 0;
  for (Vertex v : patch.line) {
    const Point foot = position(v);
    Vector normal(0, 0, 0);
    for (Halfedge h : mesh.halfedges_around_target(mesh.halfedge(v))) {
      if (mesh.is_border(h)) continue;
      normal +=
          CGAL::cross_product(position(mesh.target(mesh.next(h))) - foot, position(mesh.source(h)) - foot);
    }
    const double length = std::sqrt(normal.squared_length());
    sum += (mesh.point(v) - foot) * normal / length;
    fill_area += length / 2;
  }
  if (has_shrunk(mesh, patch, fill_area)) return unset_value;
  return sum / static_cast<double>(patch.line.size());
}

}  // namespace

namespace {

using Wanted = std::optional<std::span<const int>>;

std::vector<LineHeight> heights_of(const Mesh& mesh, std::span<const double> widths, const Wanted& wanted) {
  std::vector<LineHeight> heights;
  const auto line = find_map(mesh, attribute::line);
  if (!line) return heights;
  require_finite(mesh, "line_heights");
  require_triangles(mesh, "line_heights");
  const std::vector<double> lengths = rest_lengths(mesh);
  const bool any_width = std::any_of(widths.begin(), widths.end(), [](double w) { return w > 0; });
  const std::vector<double> before = any_width ? lengths_before_lines(mesh) : std::vector<double>{};
  std::map<int, std::vector<Vertex>> lines;
  for (Vertex v : line_vertices(mesh))
    if (!mesh.is_isolated(v) && (!wanted || std::binary_search(wanted->begin(), wanted->end(), (*line)[v])))
      lines[(*line)[v]].push_back(v);
  for (auto& [id, vertices] : lines) {
    physics::throw_if_cancelled("line_heights");
    LineHeight height{id, unset_value, vertices.size()};
    const double width = static_cast<std::size_t>(id) < widths.size() ? widths[id] : unset_value;
    const std::vector<Vertex> free =
        width > 0 ? line_region(mesh, vertices, width, before) : vertices_within_rings(mesh, vertices, 1);
    const HeightPatch patch = gather_patch(mesh, std::move(vertices), free);
    const Eigen::MatrixXd fill = harmonic_fill(mesh, patch, lengths);
    if (fill.size() > 0) height.height = mean_height(mesh, patch, fill);
    heights.push_back(height);
  }
  return heights;
}

}  // namespace

std::vector<LineHeight> line_heights(const Mesh& mesh, std::span<const double> widths) {
  return heights_of(mesh, widths, std::nullopt);
}

std::vector<LineHeight> line_heights(const Mesh& mesh, std::span<const double> widths,
                                     std::span<const int> of) {
  return heights_of(mesh, widths, of);
}

}  // namespace furrow::geometry
