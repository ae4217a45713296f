// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "io/scene/settings_schema.h"
#include "jobs/chain/keep.h"
#include "jobs/rest/drape.h"
#include "python/keywords.h"

/// Jobs that bring a scene to rest: drape, keep.
namespace furrow::python {
namespace {

// ---- drape

/// Garments over the first: the paths, or meshes into the memory.
std::vector<std::filesystem::path> over_of(const py::list& inputs, Memory& memory) {
  std::vector<std::filesystem::path> over;
  for (std::size_t i = 1; i < inputs.size(); ++i) {
    if (py::isinstance<HeldMesh>(inputs[i]))
      over.emplace_back(memory.add(py::cast<const HeldMesh&>(inputs[i]), "garment"));
    else
      take(Value{"garment", inputs[i]}, over.emplace_back());
  }
  return over;
}

Outcome outcome_of(jobs::DrapeJobReport&& report, const jobs::DrapeJob& job) {
  Outcome outcome{jobs::to_json(report)};
  if (!job.output.empty() && !report.layers) outcome.report["written"] = job.output.string();
  if (report.garments[0].animated) outcome.report["animation"] = job.settings.animation.string();
  for (const jobs::DrapeRemark& r : report.remarks)
    (r.fails ? outcome.failures : outcome.warnings).push_back(r.remark);
  outcome.succeeded = !report.fails() && !report.cancelled();
  for (jobs::Draped& d : report.garments) outcome.meshes.push_back({std::move(d.file), d.name});
  return outcome;
}

Outcome drape(const py::list& inputs, Call& call) {
  jobs::DrapeJob job;
  call.apply(keywords_of(card(job)));
  CalledScene scene = called_scene(inputs[0], io::used_by::drape, "", call);
  call.require_all_used(words_of_card<jobs::DrapeJob>(io::used_by::drape));
  job.scene = std::move(scene.input);
  Memory memory(job.scene.memory);
  job.over = over_of(inputs, memory);
  if (scene.is_file) job.more_inputs.push_back(py::cast<std::string>(py::str(inputs[0])));
  if (call.has("subdivide") && !job.subdivide)  // "auto" goes before the scene's
    if (auto& root = *job.scene.settings.root; root.contains("garment")) root["garment"].erase("subdivide");
  return outcome_of(without_lock(job, call, jobs::drape), job);
}

// ---- keep

Outcome keep(const py::list& inputs, Call& call) {
  jobs::KeepJob job;
  call.apply(keywords_of(card(job)));
  CalledScene scene = called_scene(inputs[0], io::used_by::keep, job.state_path, call);
  call.require_all_used(words_of_card<jobs::KeepJob>(io::used_by::keep));
  job.scene = std::move(scene.input);
  job.state = std::move(scene.state);
  job.state_path = scene.state_path;
  jobs::KeepReport report = without_lock(job, call, jobs::keep);
  if (!report.ran) {
    call.listener.rethrow();
    throw physics::Cancelled("cancelled");
  }
  Outcome outcome{jobs::to_json(report)};
  Json& written = outcome.report["written"] = Json::array();
  for (const auto& file : {report.mesh, report.saved_state})
    if (!file.empty()) written.push_back(file.string());
  outcome.warnings = report.warnings;
  outcome.succeeded = report.all_hold() && !report.lines.interrupted;
  if (!report.all_hold())
    outcome.failures.push_back({"not_kept", "not every line holds; the report says which, and why", "", ""});
  outcome.meshes.push_back({std::move(report.garment), garment_name(job.scene)});
  return outcome;
}

}  // namespace

void add_rest_jobs(std::vector<Runner>& runners) {
  runners.push_back({"drape", words_of_card<jobs::DrapeJob>(io::used_by::drape), drape});
  runners.push_back({"keep", words_of_card<jobs::KeepJob>(io::used_by::keep), keep});
}

}  // namespace furrow::python
