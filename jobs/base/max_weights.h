// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/mesh/vertex_attributes.h"
#include "io/base/field_words.h"
#include "io/mesh/mesh_file.h"
#include "jobs/base/card.h"

namespace furrow::jobs {

/// Keeps so many skin weights of each vertex, and notes it in the wrinkle record, for drawing the lines
/// again.
inline void limit_noted_weights(io::MeshFile& file, int count) {
  geometry::normalize_skin_weights(file.mesh, count);
  io::WrinkleRecord record = io::find_wrinkle_record(file).value();
  record.options += " " + io::flag_of("max_weights", std::to_string(count));
  io::set_wrinkle_record(file, record);
}

/// The option of the jobs that add vertices.
inline CardRow max_weights_row(std::optional<int>& count, Group group = {}, Audience audience = {}) {
  return {"max_weights",
          group,
          audience,
          &count,
          between(0, 1000),
          "keep so many of each vertex's skin weights (attributes weight_*), the largest, and make their sum "
          "1; 0: all, only normalised (default: as interpolated)"};
}

}  // namespace furrow::jobs
