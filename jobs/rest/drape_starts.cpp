// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/rest/drape_starts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

namespace furrow::jobs {
namespace {

constexpr double same_energy = 1e-6;  // of its largest part
constexpr double size_step = 0.04;    // m of a girth from one size to the next (EN 13402-3)
constexpr double hem_mark = 0.01;     // m: nearer no hem is marked
constexpr double deviations = 2;      // on each side of the mean: 19 of 20 starts

std::vector<RestNumber> numbers_of(const Draped& d) {
  std::vector<RestNumber> all;
  const auto add = [&](const std::string& name, const std::optional<double>& value) {
    if (value && std::isfinite(*value)) all.push_back({name, *value});
  };
  add("hem_height", d.hem_height);
  for (const bridge::FitEase& e : d.fit.ease) add("ease_" + e.name, e.ease);
  if (d.fit.strain) {
    add("strain_share_over", d.fit.strain->share_over);
    add("strain_p99", d.fit.strain->p99);
    add("strain_max", d.fit.strain->max);
  }
  if (d.fit.on_body) {
    add("distance_median", d.fit.distance.median);
    add("distance_p95", d.fit.distance.p95);
    add("share_in_contact", d.fit.distance.share_in_contact);
  }
  add("angle_defect", d.angle_defect);
  add("crossing_pairs", double(d.crossings.pairs));
  return all;
}

NumberSpread spread(const std::string& name, const std::vector<double>& values) {
  NumberSpread s{name, int(values.size())};
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  s.least = *least, s.most = *most;
  for (const double v : values) s.mean += v / double(values.size());
  double squares = 0;
  for (const double v : values) squares += (v - s.mean) * (v - s.mean);
  if (values.size() > 1) s.deviation = std::sqrt(squares / double(values.size() - 1));
  return s;
}

double largest_part(const bridge::EnergyParts& e) {
  return std::max(
      {std::abs(e.stretch), std::abs(e.bending), std::abs(e.ties), std::abs(e.weight), std::abs(e.contact)});
}

void doubt_outcome(const Draped& d, std::vector<Warning>& doubts) {
  std::map<std::string, int> outcomes;
  for (const DrapeStart& run : d.starts->runs) ++outcomes[run.outcome];
  if (outcomes.size() < 2) return;
  std::string text;
  for (const auto& [outcome, n] : outcomes)
    text += (text.empty() ? "" : ", ") + fmt::format("{} \"{}\"", n, outcome);
  doubts.push_back({"starts_disagree",
                    d.name + ": the start decides the outcome: of " + std::to_string(d.starts->runs.size()) +
                        " starts end " + text +
                        "; look at the garment there, or hold it with a pin or a band",
                    d.name, "simulation.starts"});
}

void doubt_number(const Draped& d, const NumberSpread& s, std::vector<Warning>& doubts) {
  const bool ease = s.name.rfind("ease_", 0) == 0, hem = s.name == "hem_height";
  const double least = ease ? size_step / 2 : hem_mark;
  if (!(ease || hem) || !(deviations * s.deviation > least)) return;
  const std::string what = ease ? "ease at the " + s.name.substr(5) : "height of the hem",
                    decides = ease ? "half the step from one size to the next" : "what a hem is marked to";
  doubts.push_back(
      {"spread_wide",
       d.name + fmt::format(": {} is {:.1f} +- {:.1f} cm over {} starts (standard deviation), which is "
                            "more than tells {} ({:.0f} mm); trust its mean no further, or hold the garment "
                            "with a pin or a band",
                            what, 100 * s.mean, 100 * s.deviation, s.count, decides, 1000 * least),
       d.name, "simulation.starts"});
}

}  // namespace

int DrapeStarts::resting() const {
  return int(std::count_if(runs.begin(), runs.end(), [](const DrapeStart& r) { return r.rests; }));
}

DrapeStart start_of(const Draped& d, std::uint64_t seed) {
  DrapeStart start;
  start.seed = seed, start.outcome = d.outcome(), start.rests = d.rests();
  start.badness = badness_of(d.end, d.limits);
  start.residual = d.report.levels.back().settle.residual;
  for (const bridge::DrapeLevel& level : d.report.levels) {
    start.iterations += level.soft.iterations + level.settle.iterations;
    start.factorisations += level.soft.factorisations + level.settle.factorisations;
  }
  start.seconds = d.seconds;
  start.energy = d.report.energy;
  start.numbers = numbers_of(d);
  return start;
}

bool is_better(const DrapeStart& a, const DrapeStart& b) {
  if (a.badness != b.badness) return a.badness < b.badness;
  return a.energy.total() < b.energy.total() - same_energy * largest_part(b.energy);
}

std::vector<NumberSpread> spread_of(std::span<const DrapeStart> starts) {
  std::vector<std::string> names{"energy"};
  std::map<std::string, std::vector<double>> values;
  for (const DrapeStart& start : starts) {
    if (!start.rests) continue;
    values["energy"].push_back(start.energy.total());
    for (const RestNumber& number : start.numbers) {
      if (!values.contains(number.name)) names.push_back(number.name);
      values[number.name].push_back(number.value);
    }
  }
  std::vector<NumberSpread> all;
  for (const std::string& name : names)
    if (!values[name].empty()) all.push_back(spread(name, values[name]));
  return all;
}

std::vector<Warning> doubts_of(const Draped& d) {
  std::vector<Warning> doubts;
  if (!d.starts) return doubts;
  doubt_outcome(d, doubts);
  for (const NumberSpread& s : d.starts->spread) doubt_number(d, s, doubts);
  return doubts;
}

Json to_json(const bridge::EnergyParts& e) {
  return {{"total", e.total()}, {"stretch", e.stretch}, {"bending", e.bending},
          {"ties", e.ties},     {"weight", e.weight},   {"contact", e.contact}};
}

Json to_json(const DrapeStarts& starts) {
  Json runs = Json::array(), spread = Json::array();
  for (const DrapeStart& r : starts.runs) {
    Json numbers = Json::object();
    for (const RestNumber& n : r.numbers) numbers[n.name] = n.value;
    runs.push_back({{"seed", r.seed},
                    {"outcome", r.outcome},
                    {"converged", r.rests},
                    {"residual_force", r.residual},
                    {"iterations", r.iterations},
                    {"factorisations", r.factorisations},
                    {"seconds", r.seconds},
                    {"energy", to_json(r.energy)},
                    {"numbers", numbers}});
  }
  for (const NumberSpread& s : starts.spread)
    spread.push_back({{"name", s.name},
                      {"count", s.count},
                      {"mean", s.mean},
                      {"deviation", s.deviation},
                      {"least", s.least},
                      {"most", s.most}});
  return {{"asked", starts.asked},
          {"resting", starts.resting()},
          {"chosen", starts.chosen},
          {"runs", runs},
          {"spread", spread}};
}

}  // namespace furrow::jobs
