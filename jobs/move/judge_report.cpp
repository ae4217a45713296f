// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/move/judge_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "jobs/base/read_inputs.h"

namespace furrow::jobs {
namespace {

std::string three_digits(double value) { return fmt::format("{:.3g}", value); }
std::string percent(double share) { return three_digits(100 * share) + " %"; }

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json row_of(const Judgement& j, const JudgedCandidate& c, bool scene_dt) {
  Json row{{"name", c.candidate.name},
           {"cost", c.cost},
           {"error", nullptr},
           {"error_is", nullptr},
           {"verdict", verdict_of(j, c)},
           {"resolved", std::isfinite(c.error) && j.resolved(c)}};
  const bool known = is_known(c);
  if (known) row["error"] = c.error, row["error_is"] = kind_of_error(j, c);
  for (const auto& [name, member] : distance_columns) row[name] = known ? Json(c.off.*member) : Json();
  row.update({{"steps", c.steps}, {"dt", c.dt}, {"flags", flags_of(c.candidate, scene_dt)}});
  return row;
}

std::string judged_on(const Judgement& j) {
  if (j.seconds >= j.scene_seconds) return "";
  return "; judged on the first " + three_digits(j.seconds) + " s of " + three_digits(j.scene_seconds) +
         " s, " + (j.shortened ? "as much as fits the budget; `budget` takes more" : "until lines are drawn");
}

std::string broken_words(const Judgement& j) {
  return j.broken == Broken::interrupted
             ? "interrupted; only what was done so far is shown"
             : "broken off, this machine takes more than three times the budget and a minute; "
               "lower `budget`, or run fewer programs beside";
}

}  // namespace

bool is_known(const JudgedCandidate& c) { return c.fate == Fate::done && std::isfinite(c.error); }

const char* kind_of_error(const Judgement& j, const JudgedCandidate& c) {
  if (&c == &j.candidates.back()) return "estimate";
  if (c.off.energy == c.error) return "energy";
  return j.by_shape ? c.off.largest() : "rms";
}

const char* verdict_of(const Judgement& j, const JudgedCandidate& c) {
  if (c.fate != Fate::done) return name_of(c.fate);
  if (!std::isfinite(c.error)) return "unknown";
  return j.meets(c) ? "meets" : "misses";
}

const char* name_of(Fate fate) {
  switch (fate) {
    case Fate::done:
      return "done";
    case Fate::diverged:
      return "diverged";
    case Fate::too_dear:
      return "too dear";
    case Fate::not_run:
      return "not run";
  }
  return "";
}

std::string words(const Judgement& j, bool scene_dt) {
  if (j.chosen < 0) {
    if (j.broken != Broken::no) return broken_words(j);
    if (!is_known(j.candidates.back()))
      return "nothing can be judged: " +
             std::string(j.candidates.back().fate == Fate::diverged ? "the reference"
                                                                    : "a run that its error is told from") +
             " diverged; look for pins or a body that move too fast, or cloth that starts deep inside the "
             "body" +
             judged_on(j);
    const double best = j.candidates.back().error;
    return "nothing that was tried is within " + percent(j.options.tolerance) +
           " of the garment's size, the reference itself is known to " + percent(best) +
           "; choose a larger `accuracy`" + judged_on(j);
  }
  const JudgedCandidate& c = j.candidates[static_cast<std::size_t>(j.chosen)];
  const bool is_reference = &c == &j.candidates.back();
  std::string text = "the cheapest setting within " + percent(j.options.tolerance) + " is " +
                     c.candidate.name + ": " + percent(c.error) +
                     (is_reference ? " by its own estimate" : std::string(" (") + kind_of_error(j, c) + ")") +
                     ", " + three_digits(c.cost) +
                     " predicted seconds a simulated second; flags: " + flags_of(c.candidate, scene_dt) +
                     judged_on(j);
  if (j.broken != Broken::no) text += "; incomplete: " + broken_words(j);
  return text;
}

Json to_json(const Judgement& j, bool scene_dt) {
  Json rows = Json::array();
  for (std::size_t i = 0; i + 1 < j.candidates.size(); ++i)
    rows.push_back(row_of(j, j.candidates[i], scene_dt));
  const JudgedCandidate& r = j.candidates.back();
  Json report{{"tolerance", j.options.tolerance},
              {"budget", j.options.budget},
              {"size", j.size},
              {"scene_seconds", j.scene_seconds},
              {"judged_seconds", j.seconds},
              {"shortened", j.shortened},
              {"dt_limit", j.dt_limit},
              {"error_is", j.by_shape ? "shape" : "positions"},
              {"why", j.why},
              {"twin_drift", j.twin_drift},
              {"reference",
               {{"name", r.candidate.name},
                {"cost", r.cost},
                {"error", number(j.reference_error)},
                {"verdict", verdict_of(j, r)},
                {"steps", r.steps},
                {"dt", r.dt},
                {"flags", flags_of(r.candidate, scene_dt)}}},
              {"candidates", rows},
              {"complete", j.broken == Broken::no}};
  report["recommendation"] = nullptr;
  if (j.chosen >= 0) {
    const JudgedCandidate& c = j.candidates[static_cast<std::size_t>(j.chosen)];
    report["recommendation"] = {{"name", c.candidate.name},
                                {"cost", c.cost},
                                {"error", c.error},
                                {"flags", flags_of(c.candidate, scene_dt)}};
  }
  report["says"] = words(j, scene_dt);
  return report;
}

}  // namespace furrow::jobs
