// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "bridge/keeping/draw_more.h"
#include "bridge/keeping/keep.h"
#include "geometry/fold/wrinkle.h"
#include "geometry/rest/rest_state.h"
#include "io/stroke/stroke_file.h"

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

/// Strokes in memory (metres, y up), or the file that they are read from.
using StrokeInput = std::variant<std::filesystem::path, std::vector<io::DrawnStroke>>;

/// The mesh on the way.
struct WrinkleStages {
  geometry::Owned<geometry::Mesh> before, inserted, displaced;
};

/// How well a cloth is shaped at one moment (geometry/quality/fold_quality.h): of lines, the worst.
struct ShapeQuality {
  std::optional<double> crest_ripple;  ///< B1, share of the crest's height; none: no line could be measured
  std::optional<double> lateral;       ///< B2, share of the width
  double angle_defect = 0;             ///< B6 [rad/m^2]
  double min_angle_deg = 0;            ///< B7, of faces in space and at rest [degrees]
  std::string worst_line = {};         ///< whose crest ripples most
};

/// The quality of a garment before and after a round of lines.
struct DrawnQuality {
  ShapeQuality before, drawn, after;  ///< drawn: raised, and not yet smoothed
};

}  // namespace furrow::jobs
