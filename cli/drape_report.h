// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <string>

#include "bridge/drape.h"
#include "bridge/fit_report.h"
#include "cli/common.h"

namespace furrow::cli {

/// One garment that was draped.
struct DrapedRow {
  std::string name;
  const bridge::DrapeReport* report;
  const bridge::FitReport* fit;
  const bridge::FitOptions* options;
  double seconds;  ///< that the fit took, without reading and the body's field [s]
};

/// All numbers, SI units; one garment's alone, or `garments`.
Json to_json(std::span<const DrapedRow> rows);

/// kNotConverged, with a word on stderr, if one did not come to rest; kInterrupted if it was stopped.
int exit_code_of(std::span<const DrapedRow> rows, const CommonArguments& common);

}  // namespace furrow::cli
