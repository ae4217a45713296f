// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/cloth/lost_lines.h"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "jobs/cloth/keep_at_rest.h"

namespace furrow::jobs {
namespace {

constexpr std::size_t most_told = 5;  // lines in one warning
constexpr double gathered_to = 0.02;  // of the length that was asked for

/// "keeps 18 % (1.8 of 10.0 mm)"
std::string words_of_loss(const LineReport& line) {
  std::ostringstream text;
  text.setf(std::ios::fixed);
  text.precision(0);
  text << (*line.kept < 0 ? "turned over, " : "keeps ") << 100 * *line.kept << " % (";
  text.precision(1);
  text << 1000 * line.height << " of " << 1000 * line.smoothed_height << " mm)";
  return text.str();
}

/// A warning of each line that its thread did not draw in as asked.
std::vector<Warning> unmet_gathers(const std::vector<LineReport>& lines) {
  std::vector<Warning> warnings;
  for (const LineReport& line : lines) {
    if (!line.gathered || std::abs(*line.gathered / *line.gather - 1) <= gathered_to) continue;
    const std::string name = line.name.value_or(std::to_string(line.id));
    warnings.push_back(
        {"line_not_gathered",
         fmt::format("'{}' is {:.1f} % of its length, not {:.1f} %: the body leaves its thread "
                     "no room, or the cloth resists; gather it less, or take a softer `fabric`",
                     name, 100 * *line.gathered, 100 * *line.gather),
         name, "`fabric`"});
  }
  return warnings;
}

}  // namespace

std::vector<Warning> lost_lines(const io::Scene& scene, const std::vector<LineReport>& lines) {
  std::string told, first;
  std::size_t lost = 0;
  for (const LineReport& line : lines) {
    if (!line.kept || *line.kept >= lost_below) continue;
    const std::string name = "'" + line.name.value_or(std::to_string(line.id)) + "'";
    if (++lost == 1) first = line.name.value_or(std::to_string(line.id));
    if (lost <= most_told) told += (told.empty() ? "" : ", ") + name + " " + words_of_loss(line);
  }
  std::vector<Warning> warnings = unmet_gathers(lines);
  if (lost == 0) return warnings;
  if (lost > most_told) told += ", and " + std::to_string(lost - most_told) + " more";
  warnings.push_back(
      {"lines_lost",
       (lines.size() == 1
            ? "the line lost more than half of its height: "
            : fmt::format("{} of {} lines lost more than half of their height: ", lost, lines.size())) +
           told + "; " +
           (keeps_first_shape(scene)
                ? "`furrow keep` finds out which lines hold, and helps those that do not"
                : "`furrow keep` makes the drawn shape the rest and helps lines that do not hold"),
       first, "`furrow keep`"});
  return warnings;
}

}  // namespace furrow::jobs
