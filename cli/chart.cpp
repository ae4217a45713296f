// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/move/chart.h"

#include <iostream>
#include <memory>

#include "cli/common.h"
#include "cli/print_text.h"
#include "cli/scene_flags.h"
#include "cli/subcommands.h"
#include "jobs/base/read_inputs.h"
#include "jobs/move/judge_report.h"

namespace furrow::cli {
namespace {

struct ChartArguments : CommonArguments {
  std::string in, csv, tolerance = "1%";
  double budget = 60;
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

/// The numbers stand beside the picture if they have no name of their own.
void name_outputs(ChartArguments& a) {
  if (a.csv.empty() && !a.out.empty())
    a.csv = std::filesystem::path(a.out).replace_extension(".csv").string();
}

ChartJob job_of(ChartArguments& a) {
  ChartJob job;
  job.options = {parse_share(a.tolerance, "--accuracy"), a.budget};
  name_outputs(a);
  job.scene = {settings(a), std::filesystem::path(a.in).parent_path()};
  job.name = a.in;
  job.csv = a.csv;
  job.picture = a.out;
  return job;
}

int chart(ChartArguments& a) {
  const ChartJob job = job_of(a);
  catch_interrupts();
  Terminal terminal(a);
  const ChartReport report = jobs::chart(job, terminal);
  CommonArguments common = a;
  common.out.clear();
  const Json json = to_json(report);
  print_report(json, common, {chart_lines(json), {a.out, a.csv}});
  const Judgement& j = report.judgement;
  const int code = exit_code_of(j.broken == Broken::interrupted, j.has_answer());
  if (code != exit_ok)
    std::cerr << "error: " << a.in << ": " << worded(words(report.judgement, report.scene_dt)) << "\n";
  return code;
}

}  // namespace

void add_chart(CLI::App& app, int& exit_code) {
  auto a = std::make_shared<ChartArguments>();
  CLI::App* sub = app.add_subcommand(
      "chart",
      "Draw speed against accuracy of integrators and steps on a scene, and name the cheapest within a "
      "tolerance\n\n"
      "  furrow chart scenes/shirt.toml\n"
      "  furrow chart scenes/shirt.toml --accuracy 0.5% --budget 120 -o chart.svg\n"
      "  furrow chart scenes/skirt.toml --set simulation.seconds=1 --json");
  sub->add_option("scene", a->in, "scene to judge (.toml), or a garment")->required();
  sub->add_option("-o,--output", a->out,
                  "picture to draw: svg or png, by gnuplot; its numbers as .csv beside it");
  sub->add_option("--csv", a->csv, "file for the chart's numbers");
  sub->add_option("--accuracy", a->tolerance,
                  "error that is accepted, as a share of the garment's diagonal (default 1%)");
  sub->add_option(
      "--budget", a->budget,
      "predicted seconds of one thread for all runs [s] (default 60); where the scene takes more, "
      "its beginning is judged");
  sub->add_option("--set", a->sets, "any setting of the scene, as key=value; may be given again")
      ->allow_extra_args(false);
  add_common_options(*sub, *a);
  sub->callback([a, &exit_code] { exit_code = chart(*a); });
}

}  // namespace furrow::cli
