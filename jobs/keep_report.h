// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "bridge/keep_lines.h"
#include "bridge/keep_shape.h"
#include "io/mesh/wrinkle_record.h"
#include "jobs/context.h"

namespace furrow::jobs {

/// What jobs::keep() did.
struct KeepReport {
  bool ran = false;                    ///< false: it was cancelled before there were lines to keep
  bridge::KeepReport lines;            ///< verdicts, rest state, certificate
  io::WrinkleRecord record;            ///< of the garment as drawn: names of lines
  io::MeshFile garment;                ///< with its new rest state [m], y up
  std::filesystem::path mesh;          ///< the settings' output; "-": not written
  Frame frame;                         ///< of the files written
  std::vector<Warning> warnings = {};  ///< about the result; those on the way went to the listener

  /// Whether every line holds, perhaps with help.
  bool all_hold() const;
};

/// "held", "held with press x10", "held with struts of 3 N/m", "held at h = 4.2 mm", or "cannot hold, because
/// ...".
std::string words(const bridge::KeptLine& line);

/// A rest state's balance and stability.
Json to_json(const bridge::KeptShape& kept);
Json to_json(const KeepReport& report);

}  // namespace furrow::jobs
