// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>

#include "cli/chart_files.h"
#include "cli/judge_report.h"
#include "cli/recorded_material.h"
#include "cli/scene_flags.h"
#include "cli/scene_input.h"
#include "cli/subcommands.h"

namespace furrow::cli {
namespace {

struct ChartArguments : CommonArguments {
  std::string in, csv, tolerance = "1%";
  double budget = 60;
  std::vector<std::string> sets;
};

io::TomlDocument settings(const ChartArguments& a) {
  io::TomlDocument document;
  if (is_scene(a.in))
    document = io::read_toml(a.in);
  else
    io::set_value(document, "garment.mesh", a.in, "the garment");
  if (a.unit) io::set_value(document, "unit", *a.unit, "--unit");
  if (a.up) io::set_value(document, "up", *a.up, "--up");
  for (const char* list : {"lines", "pins"}) io::make_list(document, list);
  apply_sets(document, a.sets);
  for (const char* list : {"lines", "pins"}) io::make_list(document, list);
  return document;
}

/// The numbers stand beside the picture if they have no name of their own.
void name_outputs(ChartArguments& a) {
  if (!a.out.empty()) check_chart_picture(a.out);
  if (a.csv.empty() && !a.out.empty())
    a.csv = std::filesystem::path(a.out).replace_extension(".csv").string();
  if (!a.csv.empty()) check_folder(a.csv);
  refuse_same({a.out, a.csv}, {a.in});
}

/// No output may replace what the scene reads.
void spare_inputs(const io::Scene& scene, const ChartArguments& a) {
  std::vector<std::string> files{scene.garment.string()};
  if (scene.body)
    for (const auto& path : {scene.body->mesh, scene.body->field, scene.body->frames})
      files.push_back(path.string());
  for (const io::SceneLines& lines : scene.lines) files.push_back(lines.strokes.string());
  refuse_same({a.out, a.csv}, files);
}

int chart(ChartArguments& a) {
  const JudgeOptions options{parse_share(a.tolerance, "--tolerance"), a.budget};
  check(options);
  name_outputs(a);
  io::TomlDocument document = settings(a);
  io::Scene scene = scene_of(document, std::filesystem::path(a.in).parent_path());
  if (take_recorded_material(document, scene.garment, nullptr))
    scene = scene_of(document, std::filesystem::path(a.in).parent_path());
  if (scene.garment.empty()) throw UsageError(document.name + ": garment.mesh is missing");
  check_inputs(scene, document, -1);
  spare_inputs(scene, a);
  take_noted_frame(scene, document);
  CommonArguments common = a;
  common.unit = scene.unit;
  common.up = scene.up;
  const SceneCloth cloth = prepare_scene(scene, common);
  const Judgement j = judge(cloth, cloth.world(scene), options, common);
  if (!a.csv.empty()) write_chart_csv(a.csv, j);
  const std::string file = std::filesystem::path(a.in).filename().string();
  if (!a.out.empty() && std::isfinite(j.reference_error))
    draw_chart(a.out, j, file + ", first " + Json(j.seconds).dump() + " s");
  common.out.clear();
  const bool scene_dt = scene.simulation.dt.has_value();
  Json report{{"scene", a.in}};
  report.update(to_json(j, scene_dt));
  print_report(report, common);
  const int code = exit_code_of(j);
  if (code != exit_ok) std::cerr << "error: " << a.in << ": " << words(j, scene_dt) << "\n";
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
      "  furrow chart scenes/shirt.toml --tolerance 0.5% --budget 120 -o chart.svg\n"
      "  furrow chart scenes/skirt.toml --set simulation.seconds=1 --json");
  sub->add_option("scene", a->in, "scene to judge (.toml), or a garment")->required();
  sub->add_option("-o,--output", a->out,
                  "picture to draw: svg or png, by gnuplot; its numbers as .csv beside it");
  sub->add_option("--csv", a->csv, "file for the chart's numbers");
  sub->add_option("--tolerance", a->tolerance,
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
