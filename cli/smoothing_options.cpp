// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/smoothing_options.h"

namespace furrow::cli {

void add_smoothing_options(CLI::App& sub, SmoothingArguments& a) {
  sub.add_option("--iterations", a.iterations,
                 "pairs of smoothing steps, a shrinking and an inflating one; 0 = none")
      ->capture_default_str();
  sub.add_option("--lambda", a.lambda, "factor of the shrinking step")->capture_default_str();
  sub.add_option("--mu", a.mu, "factor of the inflating step; < -lambda")->capture_default_str();
  sub.add_option("--weights", a.weights, "uniform, or cotangent (of the shape before smoothing)")
      ->check(CLI::IsMember({"uniform", "cotangent"}))
      ->capture_default_str();
  sub.add_flag("--keep-lines", a.keep_lines, "smooth the vertices of a line among themselves only");
  sub.add_flag("--keep-border", a.keep_border, "smooth the border as a curve of its own");
}

geometry::TaubinOptions to_options(const SmoothingArguments& a) {
  using namespace geometry;
  TaubinOptions o;
  o.iterations = a.iterations;
  o.lambda = a.lambda;
  o.mu = a.mu;
  o.weights = a.weights == "uniform" ? SmoothingWeights::uniform : SmoothingWeights::cotangent;
  o.lines = a.keep_lines ? LineRule::keep : LineRule::free;
  o.border = a.keep_border ? BorderRule::keep : BorderRule::free;
  return o;
}

}  // namespace furrow::cli
