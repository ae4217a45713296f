// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <CLI/CLI.hpp>
#include <optional>

namespace furrow::cli {

/// --max-weights of the commands that add vertices.
inline void add_max_weights(CLI::App& sub, std::optional<int>& count) {
  sub.add_option("--max-weights", count,
                 "keep so many of each vertex's skin weights (attributes weight_*), the largest, and make "
                 "their sum 1; 0: all, only normalised (default: as interpolated)")
      ->check(CLI::Range(0, 1000));
}

}  // namespace furrow::cli
