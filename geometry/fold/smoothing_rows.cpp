// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/smoothing_rows.h"

#include <algorithm>
#include <cmath>

#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/property_names.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

/// Which neighbours a vertex may average, by Taubin's labels: neither is 0, both is 2.
struct Label {
  bool line = false, border = false;
};

class RowGatherer {
 public:
  RowGatherer(const Mesh& mesh, const TaubinOptions& options)
      : mesh_(mesh),
        cotangent_(options.weights == SmoothingWeights::cotangent),
        keep_border_(options.border == BorderRule::keep) {
    if (options.lines == LineRule::keep) line_ = find_map(mesh, attribute::line);
    if (cotangent_) lengths_ = rest_lengths(mesh);
  }

  /// Neighbours of v and their weights; empty if v stays.
  void gather(Vertex v) {
    neighbours_.clear();
    weights_.clear();
    if (mesh_.is_isolated(v)) return;
    const Label own = label(v);
    if (own.line && own.border) return;
    for (Halfedge h : mesh_.halfedges_around_target(mesh_.halfedge(v))) {
      if (own.line && !label(mesh_.source(h)).line) continue;
      if (own.border && !mesh_.is_border(mesh_.edge(h))) continue;
      neighbours_.push_back(mesh_.source(h));
      if (cotangent_) weights_.push_back(own.line || own.border ? inverse_length(h) : cotangent_weight(h));
    }
    if (own.line && neighbours_.size() < 2) neighbours_.clear();
    normalise();
  }
  const std::vector<Vertex>& neighbours() const { return neighbours_; }
  const std::vector<double>& weights() const { return weights_; }  ///< empty: uniform

 private:
  Label label(Vertex v) const { return {line_ && (*line_)[v] >= 0, keep_border_ && mesh_.is_border(v)}; }
  double inverse_length(Halfedge h) const { return 1 / lengths_[mesh_.edge(h).idx()]; }
  double cotangent_weight(Halfedge h) const {
    double sum = 0;
    for (Halfedge side : {h, mesh_.opposite(h)}) {
      if (mesh_.is_border(side)) continue;
      const double a = lengths_[mesh_.edge(side).idx()], b = lengths_[mesh_.edge(mesh_.next(side)).idx()],
                   c = lengths_[mesh_.edge(mesh_.prev(side)).idx()];
      sum += 0.5 * bounded_cotangents(a, b, c)[0];
    }
    return sum;
  }
  /// Weights that sum to 1, or none (uniform) where degenerate triangles leave no sum to divide by.
  void normalise() {
    double sum = 0, largest = 0;
    for (double w : weights_) sum += w, largest = std::max(largest, std::abs(w));
    if (!(sum > 1e-12 * largest) || !std::isfinite(sum)) weights_.clear();
    for (double& w : weights_) w /= sum;
  }

  const Mesh& mesh_;
  const bool cotangent_, keep_border_;
  std::optional<VertexMap<int>> line_;
  std::vector<double> lengths_;
  std::vector<Vertex> neighbours_;
  std::vector<double> weights_;
};

std::vector<Vertex> whole_or_sorted(const Mesh& mesh, std::span<const Vertex> region) {
  std::vector<Vertex> sorted(region.begin(), region.end());
  if (region.empty()) sorted.assign(mesh.vertices().begin(), mesh.vertices().end());
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  return sorted;
}

/// Numbers the vertices that rows name from 0, by ascending mesh index, and renames them.
void number_locally(const Mesh& mesh, SmoothingRows& rows) {
  std::vector<int> local(mesh.num_vertices(), 0);
  for (int v : rows.active) local[v] = 1;
  for (int v : rows.neighbour) local[v] = 1;
  for (Vertex v : mesh.vertices()) {
    if (local[v.idx()] == 0) continue;
    local[v.idx()] = static_cast<int>(rows.vertices.size());
    rows.vertices.push_back(v);
  }
  for (int& v : rows.active) v = local[v];
  for (int& v : rows.neighbour) v = local[v];
}

}  // namespace

SmoothingRows gather_smoothing_rows(const Mesh& mesh, std::span<const Vertex> region,
                                    const TaubinOptions& options) {
  SmoothingRows rows;
  RowGatherer row(mesh, options);
  rows.first.push_back(0);
  for (Vertex v : whole_or_sorted(mesh, region)) {
    physics::throw_if_cancelled("taubin_smooth");
    row.gather(v);
    if (row.neighbours().empty()) continue;
    rows.active.push_back(static_cast<int>(v.idx()));
    for (Vertex n : row.neighbours()) rows.neighbour.push_back(static_cast<int>(n.idx()));
    const double share = 1 / static_cast<double>(row.neighbours().size());
    const bool uniform = row.weights().empty();
    if (uniform) rows.weight.resize(rows.neighbour.size(), share);
    rows.weight.insert(rows.weight.end(), row.weights().begin(), row.weights().end());
    rows.inverse_count.push_back(uniform ? share : 0);
    rows.first.push_back(static_cast<int>(rows.neighbour.size()));
  }
  number_locally(mesh, rows);
  return rows;
}

}  // namespace furrow::geometry
