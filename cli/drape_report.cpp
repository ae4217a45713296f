// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/drape_report.h"

#include <iostream>

#include "cli/fit_output.h"

namespace furrow::cli {
namespace {

Json to_json(const bridge::DrapeLevel& level) {
  return {{"vertices", level.vertices},
          {"pushed_out", level.pushed.moved},
          {"farthest_push", level.pushed.farthest},
          {"still_nearer", level.pushed.still_inside},
          {"iterations", level.settle.iterations},
          {"factorisations", level.settle.factorisations},
          {"residual", level.settle.residual}};
}

bool rests(const DrapedRow& row) { return row.report->levels.back().settle.converged && !row.falls; }

Json to_json(const DrapedRow& row) {
  const bridge::DrapeLevel& last = row.report->levels.back();
  Json levels = Json::array();
  for (const bridge::DrapeLevel& level : row.report->levels) levels.push_back(to_json(level));
  Json json{{"garment", row.name},
            {"outcome", outcome_of(row)},
            {"converged", rests(row)},
            {"residual_force", last.settle.residual},
            {"touching", last.settle.touching},
            {"contact_depth", last.settle.deepest},
            {"gap", row.gap},
            {"seconds", row.seconds},
            {"levels", levels},
            {"friction_rounds", row.report->friction_rounds},
            {"slip", row.report->slip}};
  json["fit"] = cli::to_json(*row.fit, *row.options);
  return json;
}

/// What the body does to the cloth that has come to rest on it.
void tell_contact(const DrapedRow& row, const CommonArguments& common) {
  const bridge::FitReport& fit = *row.fit;
  const double deepest = fit.distance.deepest_penetration;
  const auto faces = fit.piercing.faces;
  const std::string through = "the body comes through " + std::to_string(faces) +
                              (faces == 1 ? " face, by " : " faces, by ") +
                              (deepest < 5e-5 ? "less than 0.1 mm" : "up to " + millimetres(deepest));
  if (is_pierced(row))
    std::cerr << "error: " << row.name << ": "
              << (fit.piercing.faces ? through : "lies inside the body, by up to " + millimetres(deepest))
              << "; look at where the garment lies before it is draped (and at --unit), refine it with "
                 "--subdivide, or accept it with --penetration\n";
  else if (fit.piercing.faces)
    warn(row.name + ": " + through + "; --subdivide lets coarse cloth lie closer", common);
  if (row.too_near)
    warn(row.name + ": " + std::to_string(row.too_near) +
             " vertices are nearer to the body than the gap of " + millimetres(row.gap) + ", down to " +
             millimetres(fit.distance.min) +
             "; the cloth is too tight for it there, or the body leaves no room; choose a smaller --gap",
         common);
}

void tell_unrest(const DrapedRow& row, const CommonArguments& common) {
  const physics::SettleReport& last = row.report->levels.back().settle;
  if (last.touching == 0)
    warn(row.name + ": never came to lie on the body, which is " +
             std::to_string(row.fit->body_high - row.fit->body_low) +
             " m tall; look at where the two are, and at --unit, which is that of both files",
         common);
  if (row.falls) {
    std::cerr << "error: " << row.name
              << ": falls, as neither the body nor a pin carries it; put it where it is to be worn\n";
    return;
  }
  std::cerr << "error: " << row.name << ": not at rest after " << last.iterations
            << " iterations, residual force " << last.residual << " of a vertex's weight, cloth "
            << 1000 * last.deepest
            << " mm deep in the gap; give more with --iterations, or accept it with --residual\n";
}

}  // namespace

Json to_json(std::span<const DrapedRow> rows) {
  if (rows.size() == 1) return to_json(rows[0]);
  Json garments = Json::array();
  for (const DrapedRow& row : rows) garments.push_back(to_json(row));
  return {{"garments", garments}};
}

std::string outcome_of(const DrapedRow& row) {
  if (row.report->stopped) return "interrupted";
  const std::string rest = row.falls ? "falls" : rests(row) ? "at rest" : "not at rest";
  return rest + (is_pierced(row) ? ", pierced by the body" : "");
}

bool is_pierced(const DrapedRow& row) { return row.fit->distance.deepest_penetration > row.penetration; }

int exit_code_of(std::span<const DrapedRow> rows, const CommonArguments& common) {
  int code = exit_ok;
  for (const DrapedRow& row : rows) {
    if (row.report->stopped) return exit_interrupted;
    tell_contact(row, common);
    if (!rests(row)) tell_unrest(row, common);
    if (!rests(row) || is_pierced(row)) code = exit_not_converged;
  }
  return code;
}

}  // namespace furrow::cli
