// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/base/card.h"

#include <fmt/format.h>

#include <stdexcept>

namespace furrow::jobs {
namespace {

std::string text_of(double value) { return fmt::format("{:.9g}", value); }

/// The number of a row that has one.
std::optional<double> number_of(const CardRow& row) {
  return std::visit(
      [](const auto& x) -> std::optional<double> {
        using Value = std::remove_cvref_t<decltype(x)>;
        if constexpr (std::is_same_v<Value, OrAuto>)
          return std::optional<double>(*x.number);
        else if constexpr (std::is_same_v<Value, double*> || std::is_same_v<Value, int*> ||
                           std::is_same_v<Value, std::optional<double>*> ||
                           std::is_same_v<Value, std::optional<int>*>)
          return std::optional<double>(*x);
        else
          return std::nullopt;
      },
      row.value);
}

bool is_whole(const CardRow& row) {
  return std::holds_alternative<int*>(row.value) || std::holds_alternative<std::optional<int>*>(row.value) ||
         std::holds_alternative<OrAuto>(row.value);
}

/// The default, as its field has it before anything was set; "": none, or the words tell it.
std::string usual_of(const CardRow& row) {
  if (row.words.find("default") != row.words.npos) return "";
  if (const auto* choice = std::get_if<Choice>(&row.value)) return choice->usual;
  const std::optional<double> number = number_of(row);
  return number && !(row.range.zero_is_none && *number == 0) ? text_of(*number) : "";
}

}  // namespace

bool Range::holds(double value) const {
  if (zero_is_none && value == 0) return true;
  if (std::isinf(value)) return may_be_infinite && value > 0;
  return (above_least ? value > least : value >= least) && value <= most;
}

std::string Range::words() const {
  if (!is_bounded()) return "";
  if (most < HUGE_VAL) return (above_least ? "in (" : "in [") + text_of(least) + ", " + text_of(most) + "]";
  return (above_least ? "> " : ">= ") + text_of(least) + (may_be_infinite ? ", inf for no end" : "");
}

std::string described(const CardRow& row, bool with_range) {
  const std::string range = with_range ? row.range.words() : "", usual = usual_of(row);
  return row.words + (range.empty() ? "" : ", " + range) + (usual.empty() ? "" : " (default " + usual + ")");
}

void check(const std::vector<CardRow>& card) {
  for (const CardRow& row : card) {
    const std::optional<double> number = number_of(row);
    if (!number || row.range.holds(*number)) continue;
    const std::string range = row.range.words();
    throw std::invalid_argument("`" + row.name + "` takes a " + (is_whole(row) ? "whole " : "") + "number" +
                                (range.empty() ? "" : " " + range) + ", not " + text_of(*number));
  }
}

Choice unit_choice(std::optional<std::string>& unit) {
  return choice(unit, {{"m", "m"}, {"cm", "cm"}, {"mm", "mm"}, {"inch", "inch"}});
}

std::vector<CardRow> common_card(Frame& frame, bool& force, bool& replace) {
  using enum Group;
  using enum Audience;
  return {
      {"unit", output, everyone, unit_choice(frame.unit),
       "unit of length in the mesh and stroke files; heights are metres always (default m, or what a mesh of "
       "furrow notes)"},
      {"up", output, everyone, choice(frame.up, {{"y", "y"}, {"z", "z"}}),
       "axis that points up in those files (default y, or as noted)"},
      {"force", output, everyone, &force,
       "go on where a body, a tolerance or a step asks for very much memory or time"},
      {"replace", output, everyone, &replace,
       "write over files that furrow did not write; those that it wrote are replaced without it"},
  };
}

}  // namespace furrow::jobs
