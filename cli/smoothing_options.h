// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <CLI/CLI.hpp>
#include <string>

#include "geometry/fold/taubin_smooth.h"

namespace furrow::cli {

/// The flags of Taubin smoothing, which `smooth` and `wrinkle` share.
struct SmoothingArguments {
  int iterations = geometry::TaubinOptions{}.iterations;
  double lambda = geometry::TaubinOptions{}.lambda;
  double mu = geometry::TaubinOptions{}.mu;
  std::string weights = "uniform";
  bool keep_lines = false;
  bool keep_border = false;
};

void add_smoothing_options(CLI::App& sub, SmoothingArguments& a);
geometry::TaubinOptions to_options(const SmoothingArguments& a);

}  // namespace furrow::cli
