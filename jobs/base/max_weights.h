// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/mesh/vertex_attributes.h"
#include "io/base/field_words.h"
#include "io/mesh/mesh_file.h"

namespace furrow::jobs {

/// Keeps so many skin weights of each vertex, and notes it in the wrinkle record, for drawing the lines
/// again.
inline void limit_noted_weights(io::MeshFile& file, int count) {
  geometry::normalize_skin_weights(file.mesh, count);
  io::WrinkleRecord record = io::find_wrinkle_record(file).value();
  record.options += " " + io::flag_of("max_weights", std::to_string(count));
  io::set_wrinkle_record(file, record);
}

}  // namespace furrow::jobs
