// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "bridge/draw_more.h"
#include "bridge/keep_shape.h"
#include "geometry/fold/wrinkle.h"
#include "geometry/insert/audit_rest_metric.h"

namespace furrow::jobs {

/// A round of lines: what `wrinkle` and the rounds of a scene share.
struct LineRound {
  geometry::WrinkleReport report;
  int first_line = 0;                            ///< id of the round's first line
  std::optional<bridge::DrawMoreReport> moving;  ///< drawn into a cloth in motion: the rest of the report
  std::vector<std::string> warnings;
};

/// A round of lines that was drawn.
struct DrawnRound {
  LineRound round;
  geometry::RestMetricAudit rest;         ///< of the garment then
  double time = 0;                        ///< [s]
  std::optional<bridge::KeptShape> kept;  ///< of a round that is kept and drawn in motion
};

}  // namespace furrow::jobs
