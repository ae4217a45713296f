// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/taubin_smooth.h"

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

#include "geometry/fold/smoothing_rows.h"
#include "geometry/mesh/preconditions.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

constexpr std::size_t rows_a_question = 1024;
using Padded = Eigen::Array4d;  // x, y, z, 0: whole registers in the inner loop

/// to = from + factor (W from - from) in the rows' vertices.
template <bool is_uniform>
void filter_step(const SmoothingRows& rows, double factor, const std::vector<Padded>& from,
                 std::vector<Padded>& to) {
  const int* neighbour = rows.neighbour.data();
  const double* weight = rows.weight.data();
  for (std::size_t r = 0; r < rows.active.size(); ++r) {
    if (r % rows_a_question == 0) physics::throw_if_cancelled("taubin_smooth");
    const int last = rows.first[r + 1];
    Padded mean = Padded::Zero();
    for (int j = rows.first[r]; j < last; ++j)
      mean += is_uniform ? from[neighbour[j]] : Padded(weight[j] * from[neighbour[j]]);
    if (is_uniform) mean *= rows.inverse_count[r];
    const int i = rows.active[r];
    to[i] = from[i] + factor * (mean - from[i]);
  }
}

void check(const TaubinOptions& o, double k_max) {
  const std::string pair = "lambda " + std::to_string(o.lambda) + ", mu " + std::to_string(o.mu);
  if (o.iterations < 0 || o.iterations > 100000)
    refuse("taubin_smooth", "iterations is " + std::to_string(o.iterations) + ", not in [0, 100000]");
  if (!(o.lambda > 0) || !std::isfinite(o.lambda))
    refuse("taubin_smooth", pair + ": lambda must be finite and > 0");
  if (!(o.mu < -o.lambda) || !std::isfinite(o.mu))
    refuse("taubin_smooth", pair + ": mu must be finite and < -lambda");
  const double k_stab = stability_limit(o.lambda, o.mu);
  if (!(k_max <= k_stab))
    refuse("taubin_smooth", pair + " is unstable: it bears waves up to k_stab = " + std::to_string(k_stab) +
                                ", these weights can have k_max = " + std::to_string(k_max) +
                                "; use lambda 0.33, mu -0.34");
  if (const double pass_band = 1 / o.lambda + 1 / o.mu; !(pass_band < k_max))
    refuse("taubin_smooth", pair + ": every wave would grow, the pass band reaches k_PB = " +
                                std::to_string(pass_band) + "; use lambda 0.33, mu -0.34");
}

}  // namespace

double stability_limit(double lambda, double mu) {
  const double sum = lambda + mu, product = lambda * mu;
  return (sum - std::sqrt(sum * sum - 8 * product)) / (2 * product);
}

SmoothReport taubin_smooth(Mesh& mesh, std::span<const Vertex> region, const TaubinOptions& options) {
  SmoothReport report;
  report.k_max = options.weights == SmoothingWeights::uniform ? 2 : 3;
  check(options, report.k_max);
  require_structure(mesh, "taubin_smooth");
  require_vertices(mesh, region, "taubin_smooth");
  require_finite(mesh, "taubin_smooth");
  if (options.weights == SmoothingWeights::cotangent) require_triangles(mesh, "taubin_smooth");

  const SmoothingRows rows = gather_smoothing_rows(mesh, region, options);
  std::vector<Padded> x(rows.vertices.size()), y;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Point& p = mesh.point(rows.vertices[i]);
    x[i] = Padded(p.x(), p.y(), p.z(), 0);
  }
  y = x;
  const auto step = options.weights == SmoothingWeights::uniform ? filter_step<true> : filter_step<false>;
  for (int n = 0; n < options.iterations; ++n) {
    step(rows, options.lambda, x, y);
    step(rows, options.mu, y, x);
  }
  for (int i : rows.active) mesh.point(rows.vertices[i]) = Point(x[i][0], x[i][1], x[i][2]);

  const double sum = options.lambda + options.mu;
  report.smoothed_vertices = rows.active.size();
  report.kept_vertices = (region.empty() ? mesh.number_of_vertices() : region.size()) - rows.active.size();
  report.k_stab = stability_limit(options.lambda, options.mu);
  report.pass_band_gain = std::pow(1 - sum * sum / (4 * options.lambda * options.mu), options.iterations);
  return report;
}

}  // namespace furrow::geometry
