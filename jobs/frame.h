// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "io/mesh/mesh_file.h"

namespace furrow::jobs {

/// Unit and upward axis of the files that a job reads and writes.
struct Frame {
  /// "m", "cm", "mm" or "inch"; "y" or "z". None: what a file notes of itself, else the noted ones below.
  std::optional<std::string> unit, up;
  std::string noted_unit = "m", noted_up = "y";  ///< what an input notes, for files that note none

  /// The unit and the axis that hold.
  std::string unit_in_use() const { return unit.value_or(noted_unit); }
  std::string up_in_use() const { return up.value_or(noted_up); }
};

/// Whether it is one of the units.
bool is_unit(const std::string& unit);
/// Takes over what the first of these files that notes its unit and axis says of them.
void take_noted_frame(Frame& frame, const std::vector<std::string>& files);

/// Throw std::invalid_argument for a unit that is none.
io::ReadOptions read_options(const Frame& frame);
io::WriteOptions write_options(const Frame& frame);

}  // namespace furrow::jobs
