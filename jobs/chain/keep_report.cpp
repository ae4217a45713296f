// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "jobs/base/kept_shape.h"
#include "jobs/base/read_inputs.h"
#include "jobs/chain/keep.h"

namespace furrow::jobs {
namespace {

using bridge::KeptLine;
using bridge::Verdict;

/// A height or a share of it; null where it is not known.
Json share(double value) { return std::isfinite(value) ? Json(value) : Json(); }

const char* word_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::held:
      return "held";
    case Verdict::pressed:
      return "held with press";
    case Verdict::strutted:
      return "held with struts";
    case Verdict::lowered:
      return "lowered";
    case Verdict::may_hold:
      return "may hold";
    case Verdict::cannot_hold:
      return "cannot hold";
    case Verdict::not_known:
      return "not known";
  }
  return "";
}

std::string help_of(const KeptLine& line) {
  std::string text;
  if (line.press > 1) text += fmt::format("press x{:g}", line.press);
  if (line.struts > 0) text += fmt::format("{}struts of {:g} N/m", text.empty() ? "" : " and ", line.struts);
  return text;
}

/// A fold's height is measured as the mean along its line, faded ends and all, and is told as that of its
/// crest, which is what was asked: the factor from the one to the other; 1 for what is no fold.
double crest_share(const io::WrinkleRecord::Line& drawn) {
  const double share = drawn.crest_height.value_or(drawn.drawn_height) / drawn.drawn_height;
  return std::isfinite(share) && share > 0 ? share : 1;
}

/// A line's height as it is told, and the one that was asked for [m]; NaN: not known.
struct ToldHeight {
  double height, asked = NAN;
};
ToldHeight told_height(const KeptLine& line, const io::WrinkleRecord& record) {
  if (std::size_t(line.line) >= record.lines.size()) return {line.height};
  const io::WrinkleRecord::Line& drawn = record.lines[line.line];
  return {crest_share(drawn) * line.height, drawn.height};
}

Json to_json(const KeptLine& line, const io::WrinkleRecord& record) {
  Json json{{"id", line.line}};
  if (std::size_t(line.line) < record.lines.size()) {
    const io::WrinkleRecord::Line& drawn = record.lines[line.line];
    const double crest = crest_share(drawn);
    json.update({{"name", drawn.name},
                 {"asked", share(drawn.height)},
                 {"drawn", share(crest * drawn.drawn_height)},
                 {"smoothed", share(crest * drawn.smoothed_height)}});
  }
  json.update({{"verdict", word_of(line.verdict)},
               {"height", share(told_height(line, record).height)},
               {"kept", share(line.kept)},
               {"kept_after_gust", share(line.kept_gust)},
               {"press", line.press},
               {"struts", line.struts},
               {"lowered", share(line.lowered)},
               {"words", words(line, record)}});
  return json;
}

/// A rest state's balance and stability.
}  // namespace

bool KeepReport::all_hold() const {
  return std::all_of(lines.lines.begin(), lines.lines.end(),
                     [](const KeptLine& l) { return bridge::holds(l.verdict); });
}

std::string words(const KeptLine& line, const io::WrinkleRecord& record) {
  constexpr double no_news = 0.05;  // that a height is off [-]
  const std::string help = help_of(line), with = help.empty() ? "" : " with " + help;
  const ToldHeight told = told_height(line, record);
  const bool other = std::abs(told.height / told.asked - 1) > no_news;
  std::string at = " h = " + geometry::length_text(told.height);
  if (std::isfinite(told.asked)) at += " of " + geometry::length_text(told.asked) + " asked";
  switch (line.verdict) {
    case Verdict::held:
    case Verdict::pressed:
    case Verdict::strutted:
      return "held" + with + (other ? " at" + at : "");
    case Verdict::lowered:
      return "lowered to" + at + (help.empty() ? "" : ", with " + help);
    case Verdict::may_hold:
      return "may hold" + with + (other ? " at" + at : "") + ": " + line.reason;
    case Verdict::not_known:
      return "not known: " + line.reason;
    case Verdict::cannot_hold:
      break;
  }
  return "cannot hold" + (help.empty() ? "" : ", also with " + help) + ": " + line.reason;
}

Json to_json(const KeepReport& report) {
  const bridge::KeepReport& r = report.lines;
  Json lines = Json::array();
  for (const KeptLine& line : r.lines) lines.push_back(to_json(line, report.record));
  Json json{{"lines", lines}};
  json.update(to_json(r.rest, r.certificate));
  json.update({{"drift", r.drift}, {"trials", r.trials}, {"runs", r.runs}});
  json["crossings"] = jobs::to_json(report.crossings);
  json["end"] = jobs::to_json(report.end);
  if (r.rest_press > 1)
    json["rest_of_garment"] = {{"press", r.rest_press},
                               {"words", fmt::format("pressed x{:g} between the lines", r.rest_press)}};
  if (report.budget_spent) json["budget_spent"] = true;
  if (report.settled) json["settled"] = true;
  if (r.turned > 0) json["turned"] = r.turned;
  if (r.pushed_out > 0) json["pushed_out"] = {{"vertices", r.pushed_out}, {"farthest", r.farthest_push}};
  return json;
}

}  // namespace furrow::jobs
