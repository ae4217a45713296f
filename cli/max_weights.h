// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <CLI/CLI.hpp>
#include <optional>

#include "geometry/mesh/vertex_attributes.h"
#include "io/mesh/wrinkle_record.h"

namespace furrow::cli {

/// --max-weights of the commands that add vertices.
inline void add_max_weights(CLI::App& sub, std::optional<int>& count) {
  sub.add_option("--max-weights", count,
                 "keep so many of each vertex's skin weights (attributes weight_*), the largest, and make "
                 "their sum 1; 0: all, only normalised (default: as interpolated)")
      ->check(CLI::Range(0, 1000));
}

/// Does so, and notes it in the wrinkle record, for drawing the lines again.
inline void limit_noted_weights(io::MeshFile& file, int count) {
  geometry::normalize_skin_weights(file.mesh, count);
  io::WrinkleRecord record = io::find_wrinkle_record(file).value();
  record.options += " --max-weights " + std::to_string(count);
  io::set_wrinkle_record(file, record);
}

}  // namespace furrow::cli
