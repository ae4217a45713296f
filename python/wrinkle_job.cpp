// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/scene_rules.h"
#include "io/scene/settings_schema.h"
#include "jobs/chain/wrinkle.h"
#include "jobs/chain/wrinkle_stages.h"
#include "jobs/cloth/fabric_file.h"
#include "jobs/cloth/recorded_material.h"
#include "jobs/draw/wrinkle_reports.h"
#include "jobs/rest/drape.h"
#include "python/keywords.h"

/// furrow.wrinkle: lines become wrinkles.
namespace furrow::python {
namespace {

/// Options that the rule in use would not look at are refused, rather than ignored.
void check_call(const jobs::WrinkleJob& job, const Call& call) {
  const geometry::InsertionRule rule = job.options.insertion.rule;
  for (const std::string& name : io::options_without_use(rule))
    if (call.has(name))
      throw std::invalid_argument(name + ": the rule does not use it; it goes with rule " +
                                  (rule == geometry::InsertionRule::fold ? "safe or paper" : "fold"));
  if (call.has("subdivide") && !job.settle)
    throw std::invalid_argument("subdivide: goes with settle; furrow.subdivide refines by itself");
  if (job.density && !job.state_path.empty())
    throw std::invalid_argument("density: that of a state is changed by furrow.simulate");
}

/// What the garment is kept in, or comes to rest in: material, forces, pins and body.
jobs::SceneInput surroundings(const jobs::WrinkleJob& job, py::handle garment, Call& call) {
  jobs::SceneInput scene;
  Memory memory(scene.memory);
  if (job.state) scene.settings = io::document_of(job.state->scene, job.state_path.string());
  scene.folder = job.state_path.parent_path();
  const jobs::Frame frame = std::exchange(call.frame, {});  // that of the job, not of the settings
  call.apply_settings(io::used_by::wrinkle, scene.settings, memory);
  call.frame = frame;
  jobs::take_fabric_file(scene.settings, scene.folder);
  if (py::isinstance<HeldMesh>(garment)) {
    jobs::MemoryFiles named;
    named.meshes["garment"] = py::cast<const HeldMesh&>(garment).file;
    jobs::take_recorded_material(scene.settings, "garment", named);
  } else if (const auto* path = std::get_if<std::filesystem::path>(&job.garment); path && !job.state) {
    jobs::take_recorded_material(scene.settings, *path);
  }
  if (job.density) io::set_value(scene.settings, "material.density", *job.density, "`density`");
  if (job.keep && !job.settle) io::set_value(scene.settings, "garment.rest", "keep", "`rest=keep`");
  return scene;
}

jobs::WrinkleJob called(const py::list& inputs, Call& call) {
  jobs::WrinkleJob job;
  call.apply(keywords_of(card(job)));
  check_call(job, call);
  job.frame = call.frame;
  if (!job.state_path.empty()) {
    if (!inputs[0].is_none()) throw std::invalid_argument("state: it has its garment; leave out the mesh");
    job.state = io::read_state(job.state_path);
  } else {
    take(Value{"garment", inputs[0]}, job.garment);
  }
  take(Value{"strokes", inputs[1]}, job.strokes);
  if (job.keep) job.keep = surroundings(job, inputs[0], call);
  if (job.settle) job.settle = surroundings(job, inputs[0], call);
  return job;
}

Outcome wrinkle(const py::list& inputs, Call& call) {
  const jobs::WrinkleJob job = called(inputs, call);
  call.require_all_used(words_of_card<jobs::WrinkleJob>(job.keep || job.settle ? io::used_by::wrinkle : 0));
  jobs::WrinkleReport report = without_lock(job, call, jobs::wrinkle);
  Outcome outcome{jobs::to_json(report)};
  Json& written = outcome.report["written"] = Json::array();
  for (const auto& file : {job.output, job.inserted, job.smoothed})
    if (!file.empty()) written.push_back(file.string());
  outcome.failures = report.failures;
  outcome.succeeded = report.failures.empty() && !(report.rest && report.rest->report.stopped);
  const auto* path = std::get_if<std::filesystem::path>(&job.garment);
  outcome.meshes.push_back({std::move(report.garment), path ? path->stem().string() : "garment"});
  return outcome;
}

}  // namespace

void add_wrinkle(std::vector<Runner>& runners) {
  runners.push_back({"wrinkle", words_of_card<jobs::WrinkleJob>(io::used_by::wrinkle), wrinkle});
}

}  // namespace furrow::python
