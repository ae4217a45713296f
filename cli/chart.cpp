// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/move/chart.h"

#include <algorithm>
#include <iostream>

#include "cli/card_options.h"
#include "cli/common.h"
#include "cli/print_text.h"
#include "cli/scene_flags.h"
#include "cli/subcommands.h"
#include "jobs/base/read_inputs.h"
#include "jobs/move/judge_report.h"

namespace furrow::cli {
namespace {

struct ChartArguments : CommonArguments {
  std::string in;
  ChartJob job;
  std::vector<std::string> sets;
};

io::TomlDocument settings(const ChartArguments& a) {
  io::TomlDocument document = settings_of(a.in, "", std::nullopt);
  if (a.unit) io::set_value(document, "unit", *a.unit, "`unit`");
  if (a.up) io::set_value(document, "up", *a.up, "`up`");
  for (const char* list : {"lines", "pins"}) io::make_list(document, list);
  apply_sets(document, a.sets);
  for (const char* list : {"lines", "pins"}) io::make_list(document, list);
  return document;
}

ChartJob job_of(const ChartArguments& a) {
  ChartJob job = a.job;
  // The numbers stand beside the picture if they have no name of their own.
  if (job.csv.empty() && !job.picture.empty())
    job.csv = std::filesystem::path(job.picture).replace_extension(".csv");
  job.scene = {settings(a), std::filesystem::path(a.in).parent_path()};
  job.name = a.in;
  return job;
}

Lines chart_lines(const Json& report) {
  Lines lines{text_of(report, "says")};
  std::vector<const Json*> good;
  for (const Json& c : list_of(report, "candidates"))
    if (text_of(c, "verdict") == "meets") good.push_back(&c);
  std::stable_sort(good.begin(), good.end(),
                   [](const Json* a, const Json* b) { return value_of(*a, "cost") < value_of(*b, "cost"); });
  const std::size_t most = 4;
  for (std::size_t i = 0; i < std::min(most, good.size()); ++i)
    lines.push_back(text_of(*good[i], "name") + ": error " + per_cent(value_of(*good[i], "error")) + ", " +
                    number(value_of(*good[i], "cost")) + " s a simulated second");
  const std::size_t missed = list_of(report, "candidates").size() - good.size();
  std::string rest =
      good.size() > most ? std::to_string(good.size() - most) + " more are accurate enough" : "";
  if (missed) rest += (rest.empty() ? "" : ", ") + std::to_string(missed) + " are not, or were not run";
  if (!rest.empty()) lines.push_back(rest);
  return lines;
}

int chart(const ChartArguments& a) {
  const ChartJob job = job_of(a);
  catch_interrupts();
  Terminal terminal(a);
  const ChartReport report = jobs::chart(job, terminal);
  const Json json = to_json(report);
  print_report(json, a, {chart_lines(json), {job.picture.string(), job.csv.string()}});
  const Judgement& j = report.judgement;
  const int code = exit_code_of(j.broken == Broken::interrupted, j.has_answer());
  if (code != exit_ok)
    std::cerr << "error: " << a.in << ": " << worded(words(report.judgement, report.scene_dt)) << "\n";
  return code;
}

void add_chart(CLI::App& sub, ChartArguments& a) {
  sub.add_option("scene", a.in, "scene to judge (.toml), or a garment")->required();
  add_card(sub, card(a.job));
  sub.add_option("--set", a.sets, "any setting of the scene, as key=value; may be given again")
      ->allow_extra_args(false);
}

const Subcommand chart_subcommand(
    100, "chart",
    "Draw speed against accuracy of integrators and steps on a scene, and name the cheapest within a "
    "tolerance\n\n"
    "  furrow chart scenes/shirt.toml\n"
    "  furrow chart scenes/shirt.toml --accuracy 0.5% --budget 120 -o chart.svg\n"
    "  furrow chart scenes/skirt.toml --set simulation.seconds=1 --json",
    add_chart, chart);

}  // namespace
}  // namespace furrow::cli
