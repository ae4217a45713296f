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
  double seconds;        ///< that the fit took, without reading and the body's field [s]
  double gap;            ///< that was to be kept from the body [m]
  std::size_t too_near;  ///< vertices that do not keep it
  double penetration;    ///< depth to which the body may come through the cloth [m]
  bool falls;            ///< nothing carries it
};

/// All numbers, SI units; one garment's alone, or `garments`.
Json to_json(std::span<const DrapedRow> rows);

/// "at rest", "not at rest", "falls" or "interrupted", and whether it is pierced.
std::string outcome_of(const DrapedRow& row);
/// Whether the body comes through the cloth by more than was allowed.
bool is_pierced(const DrapedRow& row);

/// exit_not_converged, with a word on stderr, if one did not come to rest or is pierced; exit_interrupted,
/// without a word, if it was stopped. Warns of a body that comes through by less, and of cloth nearer than
/// the gap.
int exit_code_of(std::span<const DrapedRow> rows, const CommonArguments& common);

}  // namespace furrow::cli
