// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/drape_report.h"

#include <algorithm>
#include <iostream>

#include "cli/fit_output.h"

namespace furrow::cli {
namespace {

Json to_json(const bridge::DrapeLevel& level) {
  return {{"vertices", level.vertices},
          {"pushed_out", level.pushed.moved},
          {"farthest_push", level.pushed.farthest},
          {"still_inside", level.pushed.still_inside},
          {"iterations", level.settle.iterations},
          {"factorisations", level.settle.factorisations},
          {"residual", level.settle.residual}};
}

std::string outcome_of(const DrapedRow& row) {
  if (row.report->stopped) return "interrupted";
  return row.report->levels.back().settle.converged ? "at rest" : "not at rest";
}

Json to_json(const DrapedRow& row) {
  const bridge::DrapeLevel& last = row.report->levels.back();
  Json levels = Json::array();
  for (const bridge::DrapeLevel& level : row.report->levels) levels.push_back(to_json(level));
  Json json{{"garment", row.name},
            {"outcome", outcome_of(row)},
            {"converged", last.settle.converged},
            {"residual_force", last.settle.residual},
            {"touching", last.settle.touching},
            {"seconds", row.seconds},
            {"levels", levels}};
  json["fit"] = cli::to_json(*row.fit, *row.options);
  return json;
}

}  // namespace

Json to_json(std::span<const DrapedRow> rows) {
  if (rows.size() == 1) return to_json(rows[0]);
  Json garments = Json::array();
  for (const DrapedRow& row : rows) garments.push_back(to_json(row));
  return {{"garments", garments}};
}

int exit_code_of(std::span<const DrapedRow> rows, const CommonArguments& common) {
  int code = kOk;
  for (const DrapedRow& row : rows) {
    if (row.report->stopped) {
      std::cerr << "error: " << row.name
                << ": interrupted; the state reached was written, it is not at rest\n";
      return kInterrupted;
    }
    const bridge::DrapeLevel& last = row.report->levels.back();
    int inside = 0;
    for (const bridge::DrapeLevel& level : row.report->levels)
      inside = std::max(inside, level.pushed.still_inside);
    if (inside)
      warn(row.name + ": " + std::to_string(inside) + " vertices could not be brought out of the body",
           common);
    if (last.settle.converged) continue;
    if (last.settle.touching == 0)
      warn(row.name + ": never came to lie on the body; look at --unit and at where the two are", common);
    std::cerr << "error: " << row.name << ": not at rest after " << last.settle.iterations
              << " iterations, residual force " << last.settle.residual
              << " of a vertex's weight; give more with --iterations, or accept it with --residual\n";
    code = kNotConverged;
  }
  return code;
}

}  // namespace furrow::cli
