// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/move/chart.h"

#include <cmath>

#include "jobs/base/card.h"
#include "jobs/base/output_checks.h"
#include "jobs/base/read_inputs.h"
#include "jobs/cloth/fabric_file.h"
#include "jobs/cloth/recorded_material.h"
#include "jobs/move/chart_files.h"
#include "jobs/move/judge.h"
#include "jobs/move/judge_report.h"

namespace furrow::jobs {
namespace {

/// No output may replace what the scene reads.
void spare_inputs(const io::Scene& scene, const ChartJob& job) {
  std::vector<std::string> files{scene.garment.string()};
  if (scene.body)
    for (const auto& path : {scene.body->mesh, scene.body->frames}) files.push_back(path.string());
  for (const io::SceneLines& lines : scene.lines) files.push_back(lines.strokes.string());
  refuse_same({job.picture.string(), job.csv.string()}, files);
}

void check_outputs(const ChartJob& job, Listener& listener) {
  if (!job.picture.empty()) check_chart_picture(job.picture.string());
  if (!job.csv.empty()) check_folder(job.csv.string());
  check_replaced({job.picture.string(), job.csv.string()}, {job.name}, listener);
}

OpenScene open_scene(const ChartJob& job) {
  OpenScene open{{}, job.scene.settings, job.scene.folder, {}};
  take_fabric_file(open.document, open.folder);
  take_recorded_material(open.document, garment_of(open.document, open.folder), job.scene.memory);
  take_default_moving_cloth(open.document, "furrow chart");
  open.scene = scene_of(open.document, open.folder);
  if (open.scene.garment.empty())
    throw std::invalid_argument(open.document.name + ": garment.mesh is missing");
  if (open.scene.settle)
    throw std::invalid_argument(
        open.document.name +
        ": simulation.settle: a chart judges motion from the cloth as it lies; bring the "
        "garment to rest before (`furrow drape`) and chart that, or say "
        "`simulation.settle=false`");
  check_inputs(open.scene, open.document, -1, job.scene.memory);
  spare_inputs(open.scene, job);
  take_noted_frame(open.scene, open.document, job.scene.memory);
  open.frame.unit = open.scene.unit;
  open.frame.up = open.scene.up;
  return open;
}

}  // namespace

ChartReport chart(const ChartJob& job, Listener& listener) {
  check_card(job);
  check(job.options);
  check_outputs(job, listener);
  const OpenScene open = open_scene(job);
  const Context context{open.frame, listener, &job.scene.memory};
  const SceneCloth cloth = prepare_scene(open.scene, context);
  ChartReport report{job.name, judge(cloth, cloth.world(open.scene), job.options, context),
                     open.scene.simulation.dt.has_value()};
  const Judgement& j = report.judgement;
  if (!job.csv.empty()) write_chart_csv(job.csv.string(), j);
  const std::string file = std::filesystem::path(job.name).filename().string();
  if (!job.picture.empty() && std::isfinite(j.reference_error))
    draw_chart(job.picture.string(), j, file + ", first " + Json(j.seconds).dump() + " s");
  return report;
}

std::vector<CardRow> card(ChartJob& job) {
  return {
      {"output", &job.picture, "picture to draw: svg or png, by gnuplot; its numbers as .csv beside it"},
      {"csv", &job.csv, "file for the chart's numbers"},
      {"accuracy", Share{[&job](double share) { job.options.tolerance = share; }},
       "error that is accepted, as a share of the garment's diagonal (default 1%)"},
      {"budget", &job.options.budget, positive,
       "predicted seconds of one thread for all runs [s]; where the scene takes more, its beginning is "
       "judged"},
  };
}

Json to_json(const ChartReport& report) {
  Json json{{"scene", report.scene}};
  json.update(to_json(report.judgement, report.scene_dt));
  return json;
}

}  // namespace furrow::jobs
