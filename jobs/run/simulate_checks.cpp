// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/run/simulate_checks.h"

#include <algorithm>

#include "io/animation/animation_file.h"
#include "jobs/read_inputs.h"
#include "jobs/run/output_checks.h"
#include "jobs/run/recorded_material.h"

namespace furrow::jobs {
namespace {

/// Files that are read; no output may replace one, but the garment itself, by its result.
std::vector<std::string> inputs(const io::Scene& scene, const io::TomlDocument& document) {
  std::vector<std::string> files;
  if (is_scene(document.name)) files.push_back(document.name);
  if (scene.body)
    for (const auto& path : {scene.body->mesh, scene.body->field, scene.body->frames})
      files.push_back(path.string());
  for (const io::SceneLines& lines : scene.lines) files.push_back(lines.strokes.string());
  std::erase(files, "");
  return files;
}

/// Folders that a scene file names are made, so that a fresh copy of it runs; those of flags must be there.
void make_folders(const io::Scene& scene, const io::TomlDocument& document) {
  const io::SceneOutput& out = scene.output;
  const std::pair<const char*, std::filesystem::path> outputs[] = {
      {"mesh", out.mesh},         {"state", out.state},         {"inserted", out.inserted},
      {"smoothed", out.smoothed}, {"animation", out.animation}, {"body", out.body}};
  for (const auto& [key, path] : outputs)
    if (!path.parent_path().empty() && document.is_of_file("output." + std::string(key)))
      std::filesystem::create_directories(path.parent_path());
}

void check_output_formats(const io::SceneOutput& out, bool has_body) {
  for (const auto& path : {out.mesh, out.inserted, out.smoothed, out.body})
    if (!path.empty()) check_output(path.string());
  for (const auto& path : {out.inserted, out.smoothed, out.body})
    if (path == "-")
      throw std::invalid_argument("only the garment at the end (-o) can go to standard output");
  if (!out.animation.empty() && !io::animation_format(out.animation))
    throw std::invalid_argument(out.animation.string() +
                                ": the ending names no animation; choose pc2, mdd or glb");
  check_folder(out.animation.string());
  if (!out.state.empty() && out.state.extension() != ".ply")
    throw std::invalid_argument(out.state.string() + ": a state is a .ply file");
  if (!out.state.empty()) check_output(out.state.string());
  if (!out.body.empty() && !has_body)
    throw std::invalid_argument("--save-body: there is no body; name one with --body");
}

/// A state names its files in JSON, which is UTF-8: any other name would be lost.
void check_names(const io::TomlDocument& document, const std::string& key) {
  try {
    document.root.dump();
  } catch (const Json::exception&) {
    throw std::invalid_argument(
        key +
        ": the scene names a file whose name is not UTF-8, which a state cannot keep; rename that file: " +
        document.root.dump(-1, ' ', false, Json::error_handler_t::replace));
  }
}

void check_outputs(const OpenScene& open, const SimulateJob& job) {
  const io::Scene& scene = open.scene;
  const io::SceneOutput& out = scene.output;
  if (job.needs_output && out.mesh.empty() && out.state.empty() && out.animation.empty())
    throw std::invalid_argument("nothing to write: name --output, --save-state or --animation");
  check_output_formats(out, scene.body.has_value());
  if (!out.state.empty()) check_names(open.document, "output.state");
  const std::vector<std::string> read = inputs(scene, open.document);
  std::vector<std::string> written;
  for (const auto& path : {out.mesh, out.state, out.inserted, out.smoothed, out.animation, out.body}) {
    if (path.empty() || path == "-") continue;
    for (const std::string& other : read) refuse_same(path.string(), other);
    if (path != out.mesh) refuse_same(path.string(), scene.garment.string());
    if (path != out.state) refuse_same(path.string(), job.state_path.string());
    for (const std::string& other : written) refuse_same(path.string(), other);
    written.push_back(path.string());
  }
}

void check_state(const io::Scene& scene, const io::SavedState& state) {
  const io::Json garment = state.scene.value("garment", io::Json::object());
  if (scene.subdivide != garment.value("subdivide", 0))
    throw std::invalid_argument(
        "--subdivide: the garment of a state is in motion; refine it before the first step");
  if (scene.keep != (garment.value("rest", "stored") == "keep"))
    throw std::invalid_argument(
        "--rest: the garment of a state is in motion; furrow keep --state keeps its shape");
}

/// What the garment's file notes of its cloth; warns where the settings name another.
void take_material(OpenScene& open, const MemoryFiles& memory, Listener& listener) {
  const std::filesystem::path garment = open.scene.garment;
  const RecordedMaterial recorded = take_recorded_material(open.document, garment, memory);
  if (!recorded.other_cloth.is_null())
    listener.warn({"other_cloth", words_of_other_cloth(garment, recorded.other_cloth), garment.string(),
                   "material.preset"});
  if (recorded.taken) open.scene = scene_of(open.document, open.folder);
}

}  // namespace

OpenScene open_scene(const SimulateJob& job, Listener& listener) {
  OpenScene open{{}, job.scene.settings, job.scene.folder, {}};
  open.scene = scene_of(open.document, open.folder);
  if (!job.state) take_material(open, job.scene.memory, listener);
  if (job.state && job.tolerance)
    throw std::invalid_argument("tolerance: judges a scene from its beginning; leave it or the state away");
  if (open.scene.garment.empty() && !job.state)
    throw std::invalid_argument(open.document.name + ": garment.mesh is missing");
  if (job.state) check_state(open.scene, *job.state);
  check_inputs(open.scene, open.document, job.state ? job.state->lines_drawn : -1, job.scene.memory);
  if (!job.state) take_noted_frame(open.scene, open.document, job.scene.memory);
  if (is_scene(open.document.name)) make_folders(open.scene, open.document);
  check_outputs(open, job);
  open.frame.unit = open.scene.unit;
  open.frame.up = open.scene.up;
  return open;
}

}  // namespace furrow::jobs
